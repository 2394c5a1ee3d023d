import { expect, test } from "vitest";
import type { Facts } from "./facts";
import { type Box, becameTree, changed, colours } from "./picture";
import { WATCHED } from "./screens";
import { way } from "./ways";
import { SEED as base, Workshop } from "./workshop";

/** Where a stroke up from the seed goes. */
const top = { x: 597, y: 330 };
/** What that stroke sweeps, and a patch of sky that it does not touch. */
const swept: Box = { x: 540, y: 350, width: 114, height: 380 };
const away: Box = { x: 930, y: 100, width: 200, height: 200 };

const workshop = Workshop.withItsOwnServer();
const { server } = workshop;

test("a finger draws a tree that grows during the stroke", async () => {
  const { tablet } = await workshop.fresh(WATCHED);
  const before = await tablet.photograph("1-seedling");
  expect(colours(before), "ground and sky are there").toBeGreaterThan(8);

  await tablet.lead([way(base, top, 40)], 25);
  const during = await tablet.until("it grows while the finger is down", (facts) => facts.metamers > 10);
  await tablet.touch("touchEnd", []);
  const after = await tablet.untilQuiet();
  expect(after.metamers).toBeGreaterThanOrEqual(during.metamers);

  const tree = await tablet.photograph("2-drawn");
  expect(changed(before, tree, swept), "the stroke's way is overgrown").toBeGreaterThan(0.1);
  expect(becameTree(before, tree, swept), "with bark and leaves").toBeGreaterThan(0.08);
  expect(changed(before, tree, away), "the sky beside it is as it was").toBeLessThan(0.02);
});

test("two fingers pan and pinch, three rotate, and nothing grows", async () => {
  const { tablet, metamers } = await workshop.drawn();
  const { sent } = await tablet.facts();
  let last = await tablet.photograph("3-before-gestures");
  const gestures = {
    "4-panned": [way({ x: 500, y: 400 }, { x: 650, y: 330 }), way({ x: 600, y: 420 }, { x: 750, y: 350 })],
    "5-pinched": [way({ x: 560, y: 420 }, { x: 420, y: 420 }), way({ x: 640, y: 420 }, { x: 780, y: 420 })],
    "6-rotated": [
      way({ x: 400, y: 400 }, { x: 560, y: 430 }),
      way({ x: 500, y: 380 }, { x: 660, y: 410 }),
      way({ x: 600, y: 400 }, { x: 760, y: 430 }),
    ],
  };
  for (const [name, paths] of Object.entries(gestures)) {
    await tablet.swipe(paths);
    const next = await tablet.photograph(name);
    expect(changed(last, next), name).toBeGreaterThan(0.01);
    last = next;
  }
  const facts = await tablet.facts();
  expect({ metamers: facts.metamers, sent: facts.sent }).toEqual({ metamers, sent });
});

test("the tree is there after loading the page again", async () => {
  const { tablet, metamers } = await workshop.drawn();
  const empty = await (await workshop.fresh()).tablet.photograph("7-empty");
  await tablet.page.reload();
  await tablet.until("the tree is back", (facts) => facts.metamers === metamers && facts.rows >= metamers);
  const tree = await tablet.photograph("8-reloaded");
  expect(changed(empty, tree)).toBeGreaterThan(0.02);
});

test("killing the server in the middle of a stroke loses nothing", async () => {
  const { tablet } = await workshop.fresh();
  const path = way(base, top, 40);
  await tablet.lead([path.slice(0, 20)], 25);
  await server.kill();
  await tablet.until("the page notices", (facts) => facts.connection !== "connected");
  // The finger goes on while the server is away.
  for (const [i, point] of path.slice(20).entries()) {
    await tablet.touch("touchMove", [point]);
    await tablet.page.waitForTimeout(25);
    if (i === 10) await server.start();
  }
  await tablet.touch("touchEnd", []);
  const facts = await tablet.untilQuiet();
  expect(facts.metamers).toBeGreaterThan(20);
  await tablet.show("9-after-a-kill");

  await tablet.page.reload();
  await tablet.until("the tree is back", ({ metamers }) => metamers === facts.metamers);
});

test("a second tablet sees the same growth and may draw", async () => {
  const { tablet: first, address, metamers } = await workshop.drawn();
  const second = await workshop.open(address);
  await second.until("it sees the tree", (facts) => facts.metamers === metamers && facts.rows > 0);
  await second.swipe([way({ x: 597, y: 550 }, { x: 780, y: 400 })]);
  await second.untilQuiet();
  const two = await second.facts();
  expect(two.metamers).toBeGreaterThan(metamers);
  const same = ({ metamers, rows, step }: Facts) => metamers === two.metamers && rows === two.rows && step === two.step;
  await first.until("both see the same", same);
});

test("undo takes the stroke back and redo gives it again", async () => {
  const { tablet, metamers } = await workshop.drawn();
  await tablet.tap("Undo");
  await tablet.until("the tree is gone", (facts) => facts.metamers === 0);
  await tablet.tap("Redo");
  await tablet.until("the tree is back", (facts) => facts.metamers === metamers);
});

test("the grow control grows and ungrows", async () => {
  const { tablet, metamers } = await workshop.drawn();
  const box = await tablet.boxOf(tablet.page.getByLabel("Grow", { exact: true }));
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  const hold = async (y: number, what: string, done: (metamers: number) => boolean) => {
    await tablet.touch("touchStart", [middle]);
    await tablet.touch("touchMove", [{ x: middle.x, y }]);
    await tablet.until(what, (facts) => done(facts.metamers));
    await tablet.touch("touchEnd", []);
    return tablet.untilQuiet();
  };
  const grown = await hold(box.y + 12, "it grows", (now) => now > metamers);
  await tablet.show("10-grown");
  const ungrown = await hold(box.y + box.height - 12, "it ungrows", (now) => now < metamers);
  expect(ungrown.step).toBeLessThan(grown.step);
});

test("the brush radius changes in the middle of a stroke", async () => {
  const { tablet } = await workshop.fresh();
  const slider = tablet.page.getByLabel("Brush radius", { exact: true });
  const box = await tablet.boxOf(slider);
  const radius = async () => Number(await slider.getAttribute("aria-valuenow"));
  const before = await radius();
  const finger = { x: base.x, y: 600 };
  await tablet.lead([way(base, finger, 12)]);
  const thumb = { x: box.x + box.width / 2, y: box.y + 10 };
  await tablet.touch("touchStart", [finger, thumb]);
  await tablet.touch("touchMove", [{ x: finger.x, y: finger.y - 12 }, thumb]);
  await expect.poll(radius).toBeGreaterThan(before);
  const { sent } = await tablet.facts();
  await tablet.touch("touchMove", [{ x: finger.x, y: finger.y - 40 }, thumb]);
  await tablet.until("the stroke goes on", (facts) => facts.sent > sent);
  await tablet.touch("touchEnd", []);
  expect(await radius()).toBeGreaterThan(before);
  expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(0);
});

test("a tree is saved, found in the library and opened again", async () => {
  const { tablet, metamers } = await workshop.drawn();
  const { page } = tablet;
  await tablet.tap("Save");
  await page.getByLabel("Name", { exact: true }).fill("My pear");
  await page.getByRole("button", { name: "Save tree" }).tap();
  await page.getByText("Saved “My pear”").waitFor();
  await tablet.tap("New tree");
  await tablet.until("an empty ground", (facts) => facts.connection === "connected" && facts.metamers === 0);
  await tablet.tap("Library");
  const card = page.getByLabel("Open My pear", { exact: true });
  await card.waitFor();
  const picture = card.locator("img");
  await picture.waitFor();
  expect(
    await picture.evaluate((image: HTMLImageElement) => image.decode().then(() => image.naturalWidth)),
  ).toBeGreaterThan(100);
  await tablet.show("11-library");
  const address = page.url();
  await card.tap();
  await tablet.until("the tree is open", (facts) => facts.metamers === metamers);
  expect(page.url()).not.toBe(address);
});

test("the page fits an upright tablet", async () => {
  const address = await server.newSession(5);
  const tablet = await workshop.open(address, { width: 834, height: 1194, detail: 0.5 });
  const before = await tablet.photograph("12-upright-seedling");
  await tablet.swipe([way({ x: 417, y: 1000 }, { x: 417, y: 500 })]);
  await tablet.untilQuiet();
  const after = await tablet.photograph("13-upright");
  expect(changed(before, after)).toBeGreaterThan(0.01);
  for (const label of ["Brush radius", "Grow", "Undo", "Redo", "Architecture", "Scene", "More"]) {
    const box = await tablet.boxOf(tablet.page.getByLabel(label, { exact: true }).first());
    expect(box.x >= 0 && box.y >= 0 && box.x + box.width <= 834 && box.y + box.height <= 1194, label).toBe(true);
  }
});
