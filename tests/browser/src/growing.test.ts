import { expect, test } from "vitest";
import { pickSpecies } from "./by-hand";
import { SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { middle, way } from "./ways";
import { seedling, Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();
const { server } = workshop;

/** Ways to have the tree grow as long as one likes: each begins it, and gives what ends it. */
const HOLDS = {
  "the lever at its end": async (tablet: Tablet) => {
    const lever = await tablet.boxOf(tablet.page.getByLabel("Grow", { exact: true }));
    await tablet.lead([way(middle(lever), { x: middle(lever).x, y: lever.y + 4 }, 4)]);
    return () => tablet.touch("touchEnd", []);
  },
  "the key G": async (tablet: Tablet) => {
    await tablet.page.keyboard.down("g");
    return () => tablet.page.keyboard.up("g");
  },
};

test.each(Object.entries(HOLDS))("growth ends within a step of letting go: %s", async (_, hold) => {
  const { tablet, address } = await workshop.fresh(SMALL);
  await workshop.act(address, [{ kind: "grow", steps: 8 }]);
  await tablet.untilQuiet();
  const begun = (await tablet.facts()).step;
  const release = await hold(tablet);
  await tablet.until("it grows on", ({ step }) => step >= begun + 3);
  // The server falls behind, and the hand does not know.
  server.pause();
  // What was on its way arrives, and a step is asked for.
  for (let frame = 0; frame < 30; frame++) await tablet.frames();
  const { step, sent } = await tablet.facts();
  for (let frame = 0; frame < 30; frame++) await tablet.frames();
  expect((await tablet.facts()).sent, "and no other before it is done").toBe(sent);
  await release();
  await tablet.until("it is told to stop", (facts) => facts.sent === sent + 1);
  server.resume();
  const rested = await tablet.untilQuiet();
  expect(rested.step).toBeGreaterThanOrEqual(step);
  expect(rested.step).toBeLessThanOrEqual(step + 1);
  await tablet.tap("Undo");
  await tablet.until("it is one operation", (facts) => facts.step === begun);
});

/** Has the server grow on bit by bit until the page offers to stop it, and stand still then: a slow page sees it in time. */
async function untilItCanBeStopped({ page }: Tablet): Promise<void> {
  const button = page.getByRole("button", { name: "Stop", exact: true });
  const tries = 50;
  for (let tried = 0; tried < tries; tried++) {
    server.pause();
    const seen = button.waitFor({ timeout: 2000 }).then(() => true);
    if (await seen.catch(() => false)) return;
    server.resume();
    await new Promise((done) => setTimeout(done, 100));
  }
  throw new Error("the page does not offer to stop what grows");
}

const STOPS = {
  "the button": (tablet: Tablet) => tablet.page.getByRole("button", { name: "Stop", exact: true }).tap(),
  Escape: (tablet: Tablet) => tablet.page.keyboard.press("Escape"),
};

test.each(Object.entries(STOPS))("growth that someone else began can be stopped with %s", async (_, stop) => {
  const { tablet, address } = await workshop.fresh(SMALL);
  await workshop.begin(address, [{ kind: "grow", steps: 1000 }]);
  await untilItCanBeStopped(tablet);
  await stop(tablet);
  server.resume();
  const { step } = await tablet.untilQuiet();
  expect(step).toBeLessThan(1000);
  expect(await tablet.page.locator(".note.full").count(), "nor did it end of itself").toBe(0);
  await tablet.page.getByRole("button", { name: "Stop", exact: true }).waitFor({ state: "detached" });
});

test("a lever that is stopped leaves the finger that holds it", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const lever = await tablet.boxOf(tablet.page.getByLabel("Grow", { exact: true }));
  await tablet.lead([way(middle(lever), { x: middle(lever).x, y: lever.y + 4 }, 4)]);
  await tablet.page.getByRole("button", { name: "Stop", exact: true }).waitFor();
  await tablet.page.keyboard.press("Escape");
  const { step } = await tablet.untilQuiet();
  await tablet.touch("touchMove", [{ x: middle(lever).x, y: lever.y + 8 }]);
  await tablet.frames();
  expect((await tablet.untilQuiet()).step).toBe(step);
  await tablet.touch("touchEnd", []);
});

test("a stroke that is stopped is over, though the finger goes on", async () => {
  const { tablet, address } = await workshop.fresh(SMALL);
  const seed = await seedling(tablet);
  const rise = way(seed, { x: seed.x, y: seed.y - 260 }, 40);
  await tablet.lead([rise.slice(0, 20)]);
  // Long growth of someone else keeps the button there.
  await workshop.begin(address, [{ kind: "grow", steps: 1000 }]);
  await untilItCanBeStopped(tablet);
  await tablet.page
    .getByRole("button", { name: "Stop", exact: true })
    .evaluate((button: HTMLElement) => button.click());
  server.resume();
  const { sent } = await tablet.untilQuiet();
  for (const point of rise.slice(20)) await tablet.touch("touchMove", [point]);
  await tablet.frames();
  expect((await tablet.untilQuiet()).sent).toBe(sent);
  await tablet.touch("touchEnd", []);
});

test("what is drawn on a young pine stays when it grows, and goes where shedding is set by hand", async () => {
  const { tablet, address } = await workshop.fresh(SMALL);
  await pickSpecies(tablet, "scots-pine");
  // By one move of a brush, so that the tree is young still.
  await workshop.act(address, [
    { kind: "stroke_begin", stroke: 1 },
    { kind: "stroke_move", stroke: 1, samples: [{ position: [0, 8, 0], radius: 6 }] },
    { kind: "stroke_end", stroke: 1 },
  ]);
  const drawn = await tablet.until("it is drawn", (facts) => facts.metamers > 50);
  await tablet.untilQuiet();
  const grown = async () => {
    const before = await tablet.untilQuiet();
    await workshop.act(address, [{ kind: "grow", steps: 1 }]);
    await tablet.until("it grows on", (facts) => facts.step > before.step);
    return (await tablet.untilQuiet()).metamers;
  };
  expect(await grown()).toBeGreaterThan(0.9 * drawn.metamers);
  await workshop.act(address, [{ kind: "set_parameters", parameters: { shedding_threshold: 0.9 } }]);
  expect(await grown()).toBeLessThan(drawn.metamers / 2);
});
