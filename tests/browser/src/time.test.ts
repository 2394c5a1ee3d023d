import { expect, test } from "vitest";
import { type Box, changed } from "./picture";
import { LANDSCAPE, type Screen, WATCHED } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { type Point, way } from "./ways";
import { type Grown, SEED, Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** Where the stroke of the limb begins, beside the stem: on it a finger that is slow to move would choose. */
const fork: Point = { x: SEED.x + 30, y: 560 };
/** Where it ends. */
const tip: Point = { x: 830, y: 480 };

/** The picture without what lies along its foot. */
const workspace: Box = { x: 140, y: 80, width: 1040, height: 600 };

/** A stem with one limb to the right, each a stroke of its own. */
async function limbed(screen?: Screen): Promise<Grown> {
  const { tablet, address } = await workshop.stem(screen);
  await tablet.swipe([way(fork, tip)]);
  const { metamers } = await tablet.untilQuiet();
  return { tablet, address, metamers };
}

/** Drags along the strip of time, from one share of its length to another. */
async function scrub(tablet: Tablet, from: number, to: number, lift = true): Promise<void> {
  const track = await tablet.boxOf(tablet.page.getByRole("slider", { name: "Time" }));
  const at = (share: number) => ({ x: track.x + track.width * share, y: track.y + track.height / 2 });
  await tablet.lead([way(at(from), at(to), 16)]);
  if (lift) await tablet.touch("touchEnd", []);
}

test("the strip scrubs back through growth and forth again", async () => {
  const { tablet, metamers } = await limbed(WATCHED);
  const before = await tablet.facts();
  expect([before.operations, before.done, before.present]).toEqual(["stroke stroke", 2, before.lastStep]);
  const grown = await tablet.photograph("50-strip");

  await scrub(tablet, 1, 0.3, false);
  await tablet.until("the tree is as it was", (facts) => facts.present < before.present && facts.metamers < metamers);
  await until("the limb is gone", async () => changed(grown, await tablet.glimpse("51-scrubbing")) > 0.005);
  await tablet.touch("touchEnd", []);

  await scrub(tablet, 0.3, 0);
  await tablet.until("nothing has grown", (facts) => facts.present === 0 && facts.metamers === 0);
  await scrub(tablet, 0, 1);
  await tablet.until("all has grown", (facts) => facts.present === before.lastStep);
  const after = await tablet.untilQuiet();
  expect([after.metamers, after.operations]).toEqual([metamers, before.operations]);
});

test("keys, taps and buttons travel through time", async () => {
  const { tablet } = await limbed();
  const { page } = tablet;
  const { lastStep } = await tablet.facts();
  await tablet.tap("One step back");
  await tablet.until("a step back", (facts) => facts.present === lastStep - 1);
  await page.keyboard.press(",");
  await tablet.until("another", (facts) => facts.present === lastStep - 2);
  await page.keyboard.press(".");
  await page.keyboard.press(".");
  await tablet.until("both again", (facts) => facts.present === lastStep);
  const slider = page.getByRole("slider", { name: "Time" });
  await slider.focus();
  await page.keyboard.press("Home");
  await tablet.until("the beginning", (facts) => facts.present === 0);
  const says = () => slider.getAttribute("aria-valuetext");
  await expect.poll(says).toBe(`Step 0 of ${lastStep}`);
  await page.keyboard.press("PageUp");
  const first = await tablet.until("the first stroke", (facts) => facts.present > 0 && facts.present < lastStep);
  await expect.poll(says).toBe(`Step ${first.present} of ${lastStep}, Stroke`);
  const track = await tablet.boxOf(slider);
  await tablet.tapAt({ x: track.x + track.width - 8, y: track.y + 16 });
  await tablet.until("the end of what was tapped", (facts) => facts.present === lastStep);
});

test("another future stays reachable from where it branched off", async () => {
  const { tablet, address, metamers } = await limbed();
  const { page } = tablet;
  const one = await tablet.facts();
  await tablet.tap("Undo");
  await tablet.until("the limb is gone", (facts) => facts.metamers < metamers);
  await tablet.untilQuiet();
  await tablet.swipe([way({ x: SEED.x - 30, y: 560 }, { x: 360, y: 470 })]);
  await tablet.until("a future is kept", (facts) => facts.futures === 1);
  const two = await tablet.untilQuiet();

  const other = await workshop.open(address);
  await other.until("others know of it", (facts) => facts.futures === 1);

  await page.getByRole("button", { name: "Another future" }).tap();
  await page.getByText("1 operation,").waitFor();
  await tablet.show("52-futures");
  await page.getByText("1 operation,").tap();
  await tablet.until("the first future is back", (facts) => facts.metamers === metamers);
  const back = await tablet.untilQuiet();
  expect([back.lastStep, back.futures]).toEqual([one.lastStep, 1]);

  await page.getByRole("button", { name: "Another future" }).tap();
  await page.getByText("1 operation,").tap();
  await tablet.until(
    "and the second again",
    (facts) => facts.lastStep === two.lastStep && facts.metamers === two.metamers,
  );
});

test("the strip folds away and remembers it", async () => {
  const { tablet } = await limbed();
  const { page } = tablet;
  await tablet.tap("Hide the timeline");
  await page.getByLabel("Show the timeline").waitFor();
  await page.reload();
  await tablet.untilReady();
  await page.getByLabel("Show the timeline").waitFor();
  expect(await page.getByRole("slider", { name: "Time" }).count()).toBe(0);
  await tablet.tap("Show the timeline");
  await page.getByRole("slider", { name: "Time" }).waitFor();
});

test("the strip and its targets fit an upright tablet", async () => {
  const tablet = await workshop.open(await workshop.server.newSession(5), { width: 834, height: 1194, detail: 0.5 });
  await tablet.swipe([way({ x: 417, y: 1000 }, { x: 417, y: 600 })]);
  await tablet.untilQuiet();
  await tablet.show("53-upright-strip");
  for (const label of ["Hide the timeline", "One step back", "Time", "One step forth"]) {
    const box = await tablet.boxOf(tablet.page.getByLabel(label, { exact: true }));
    expect(box.x >= 0 && box.x + box.width <= 834 && box.y + box.height <= 1194, label).toBe(true);
    expect(Math.min(box.width, box.height), label).toBeGreaterThanOrEqual(44);
  }
});

test("one finger turns a branch about its base, and undo turns it back", async () => {
  const { tablet, metamers } = await limbed(LANDSCAPE);
  await tablet.take("Branch");
  await tablet.tapAt(tip);
  const held = await tablet.until("the limb is held", (facts) => facts.branch !== "");
  const before = await tablet.photograph("54-branch-held");
  // The server answers nothing until the picture has been looked at.
  workshop.server.pause();
  const up: Point = { x: 660, y: 330 };
  await tablet.lead([way(tip, up)]);
  let during = before;
  await until("it turns before the server knows", async () => {
    during = await tablet.glimpse("55-branch-turning");
    return changed(before, during) > 0.002;
  });
  expect((await tablet.facts()).operations).toBe("stroke stroke");
  workshop.server.resume();
  await tablet.touch("touchEnd", []);
  const turned = await tablet.untilQuiet();
  expect([turned.operations, turned.branch, turned.metamers]).toEqual(["stroke stroke turn", held.branch, metamers]);
  await tablet.tap("Undo");
  await tablet.until("it is undone", (facts) => facts.done === 2);
  await tablet.untilQuiet();
  const undone = await tablet.photograph("56-turned-back");
  expect(changed(before, undone), "nothing is left of the turn").toBeLessThan(changed(before, during) / 4);
});

test("a second finger twists a branch about itself", async () => {
  const { tablet } = await limbed();
  await tablet.take("Branch");
  await tablet.tapAt(tip);
  await tablet.until("the limb is held", (facts) => facts.branch !== "");
  const round = way({ x: 0, y: 0 }, { x: Math.PI / 2, y: 0 }).map(({ x: angle }) => ({
    x: tip.x + 120 * Math.cos(angle),
    y: tip.y + 120 * Math.sin(angle),
  }));
  await tablet.touch("touchStart", [tip]);
  await tablet.touch("touchStart", [tip, round[0]!]);
  for (const point of round.slice(1)) await tablet.touch("touchMove", [tip, point]);
  await tablet.touch("touchEnd", []);
  await tablet.until("it is turned", (facts) => facts.operations === "stroke stroke turn");
});

test("a branch is copied to another limb, and moved there", async () => {
  const { tablet, metamers } = await limbed(LANDSCAPE);
  const { page } = tablet;
  await tablet.take("Branch");
  await tablet.tapAt(tip);
  await tablet.until("the limb is held", (facts) => facts.branch !== "");
  await page.getByRole("button", { name: "Copy" }).tap();
  const onto: Point = { x: SEED.x, y: 470 };
  await tablet.lead([way(onto, { x: 420, y: 430 })]);
  await tablet.showNow("57-copy-on-its-way");
  await tablet.touch("touchEnd", []);
  await tablet.until("the copy is there", (facts) => facts.operations === "stroke stroke graft");
  const held = await tablet.untilQuiet();
  expect(held.metamers).toBeGreaterThan(metamers);
  await tablet.show("58-copied");

  await page.getByRole("button", { name: "Move" }).tap();
  await tablet.tapAt({ x: SEED.x, y: 640 });
  await tablet.until("it is moved", (facts) => facts.operations === "stroke stroke graft graft");
  const moved = await tablet.untilQuiet();
  expect([moved.metamers, moved.futures]).toEqual([held.metamers, 0]);
});

test("a prediction grows beside the tree and is kept as it was seen", async () => {
  const { tablet, metamers } = await limbed(LANDSCAPE);
  const { page } = tablet;
  const before = await tablet.photograph("59-before-the-cut");
  await tablet.take("Prune");
  await page.getByLabel("What if?", { exact: true }).check();
  await tablet.tapAt({ x: (fork.x + tip.x) / 2, y: (fork.y + tip.y) / 2 });
  await tablet.until("the ghost is there", (facts) => facts.ghost === "10");
  const ghost = await tablet.photograph("60-prediction");
  expect(changed(before, ghost), "a ghost is seen").toBeGreaterThan(0.01);
  const { operations } = await tablet.facts();
  expect([operations, (await tablet.facts()).metamers]).toEqual(["stroke stroke", metamers]);

  await page.getByLabel("Steps ahead", { exact: true }).focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowLeft");
  await tablet.until("it looks less far", (facts) => facts.ghost === "8");
  await page.keyboard.press("Escape");
  await tablet.until("it is discarded", (facts) => facts.ghost === "");
  expect((await tablet.untilQuiet()).operations).toBe("stroke stroke");
  // The camera goes back to where it was.
  const after = await tablet.photograph("61-discarded");
  expect(changed(before, after, workspace), "everything is as it was").toBeLessThan(0.01);

  await tablet.tapAt({ x: (fork.x + tip.x) / 2, y: (fork.y + tip.y) / 2 });
  await tablet.until("it is there again", (facts) => facts.ghost === "8");
  await page.getByRole("button", { name: "Keep this" }).tap();
  await tablet.until("it is done", (facts) => facts.operations === "stroke stroke prune" && facts.ghost === "");
  const kept = await tablet.untilQuiet();
  await tablet.show("62-kept");
  expect(kept.lastStep).toBeGreaterThan(2);
  await tablet.tap("Undo");
  await tablet.until("one operation is undone", (facts) => facts.metamers === metamers && facts.done === 2);
});

test("PD2: whatever else is done ends a prediction, also one in the making", async () => {
  const { tablet } = await limbed();
  const { page } = tablet;
  const bar = page.getByRole("region", { name: "Prediction" });
  const ask = () => tablet.tapAt({ x: (fork.x + tip.x) / 2, y: (fork.y + tip.y) / 2 });
  await tablet.take("Prune");
  await page.getByLabel("What if?", { exact: true }).check();
  await ask();
  await tablet.until("the ghost is there", (facts) => facts.ghost === "10");
  await page.getByLabel("Steps ahead", { exact: true }).focus();
  await page.keyboard.press("End");
  await tablet.tap("Undo");
  await bar.waitFor({ state: "detached" });
  await tablet.until("one stroke is undone", (facts) => facts.done === 1 && facts.ghost === "");
  await tablet.tap("Redo");
  expect((await tablet.untilQuiet()).done).toBe(2);
  await ask();
  await tablet.until("another one is made", (facts) => facts.ghost === "30");
});
