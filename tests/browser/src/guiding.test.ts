import { expect, test } from "vitest";
import { type Box, becameTree, changed } from "./picture";
import { LANDSCAPE } from "./screens";
import type { Tablet } from "./tablet";
import { loop, type Point, way } from "./ways";
import { SEED as base, Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();
const { server } = workshop;

async function widen(tablet: Tablet): Promise<void> {
  const slider = tablet.page.getByLabel("Brush radius", { exact: true });
  await slider.focus();
  for (let notch = 0; notch < 6; notch++) await tablet.page.keyboard.press("ArrowUp");
}

/** How many metamers of a session's tree belong to its trunk. */
async function trunk(address: string): Promise<number> {
  const answer = await fetch(`${address.replace("/s/", "/api/v1/sessions/")}/tree.json`);
  const { metamers } = (await answer.json()) as { metamers: { axis: number }[] };
  return metamers.filter(({ axis }) => axis === 0).length;
}

test("a lasso grows a crown that fills its outline", async () => {
  const { tablet, metamers } = await workshop.stem(LANDSCAPE);
  const before = await tablet.photograph("20-stem");
  await tablet.take("Lasso");

  await tablet.lead([loop({ x: 597, y: 330 }, { x: 210, y: 170 })]);
  const shown = tablet.page.locator('.outline[data-stage="drawing"] .outline-body');
  await expect.poll(() => shown.getAttribute("d"), { message: "it shows while it is drawn" }).toContain("L");
  await tablet.showNow("21-outline");
  expect((await tablet.facts()).metamers, "nothing grows before the finger lifts").toBe(metamers);
  await tablet.touch("touchEnd", []);
  const grown = await tablet.untilQuiet();
  expect(grown.metamers).toBeGreaterThan(metamers + 200);
  await tablet.page.locator(".outline").waitFor({ state: "detached" });

  const crown = await tablet.photograph("22-crown");
  const inside: Box = { x: 480, y: 230, width: 234, height: 200 };
  const outside: Box = { x: 930, y: 130, width: 180, height: 300 };
  expect(becameTree(before, crown, inside)).toBeGreaterThan(0.3);
  expect(becameTree(before, crown, outside)).toBeLessThan(0.01);
  await tablet.tap("Undo");
  await tablet.until("the crown is one operation", (facts) => facts.metamers === metamers);
});

test("an outline is cancelled with Escape, and a small one is a slip", async () => {
  const { tablet } = await workshop.stem();
  await tablet.take("Lasso");
  const { sent } = await tablet.facts();
  const shown = tablet.page.locator(".outline");
  await tablet.lead([loop({ x: 597, y: 330 }, { x: 210, y: 170 })]);
  await shown.waitFor();
  await tablet.page.keyboard.press("Escape");
  await shown.waitFor({ state: "detached" });
  await tablet.touch("touchEnd", []);
  await tablet.swipe([loop({ x: 900, y: 300 }, { x: 8, y: 8 }, 12)]);
  await tablet.page.getByText("Draw a larger outline").waitFor();
  expect((await tablet.facts()).sent).toBe(sent);
});

test("a long growth can be stopped, and what has grown stays", async () => {
  const { tablet, metamers } = await workshop.stem();
  // From so far away an outline as large as the glass takes long to fill.
  for (let pinch = 0; pinch < 3; pinch++) {
    await tablet.swipe([way({ x: 350, y: 420 }, { x: 510, y: 420 }), way({ x: 850, y: 420 }, { x: 690, y: 420 })]);
  }
  await tablet.take("Lasso");
  const outline = loop({ x: 620, y: 400 }, { x: 430, y: 330 }, 60);
  // The server pauses until the button is pressed: it might be done before a test's finger gets there.
  server.pause();
  await tablet.swipe([outline], 4);
  await tablet.page.locator(".chip-stop").tap();
  server.resume();
  await tablet.until("something has grown", (facts) => facts.metamers > metamers);
  const stopped = await tablet.untilQuiet();
  await tablet.page.locator(".outline").waitFor({ state: "detached" });
  await tablet.tap("Undo");
  await tablet.until("it is one operation", (facts) => facts.metamers === metamers);

  await tablet.swipe([outline], 4);
  const whole = await tablet.untilQuiet();
  expect(whole.metamers, "what was stopped is less").toBeGreaterThan(stopped.metamers);
});

test("SG1: a branch pressed and held grows alone until it is let go", async () => {
  const { tablet, address, metamers } = await workshop.stem(LANDSCAPE);
  const stem = await trunk(address);
  const at = (y: number): Point => ({ x: base.x, y });
  // A limb to the right, to be held; the stem's tip is far from it.
  await tablet.swipe([way(at(600), { x: 800, y: 520 })]);
  const limbed = await tablet.untilQuiet();
  expect(limbed.metamers).toBeGreaterThan(metamers + 3);

  const filled = await tablet.watchFor(".hold-fill");
  const chosen = await tablet.hold({ x: 745, y: 542 }, "a branch is chosen", ({ bud }) => bud !== "");
  await filled();
  expect(chosen.sent, "holding draws nothing").toBe(limbed.sent);
  await tablet.page.getByText("Only this branch grows").waitFor();
  await tablet.showNow("23-chosen");

  await widen(tablet);
  const aroundTip = [way(at(390), at(300))];
  await tablet.swipe(aroundTip);
  const alone = await tablet.untilQuiet();
  expect(alone.sent).toBeGreaterThan(chosen.sent);
  expect(await trunk(address), "the stem does not follow the brush").toBe(stem);
  await tablet.swipe([way({ x: 795, y: 510 }, { x: 880, y: 420 })]);
  await tablet.until("the limb does", ({ metamers }) => metamers > limbed.metamers);
  const followed = await tablet.untilQuiet();
  await tablet.show("24-grew-alone");

  await tablet.tap("Let every branch grow");
  await tablet.until("it is let go", ({ bud }) => bud === "");
  await tablet.swipe(aroundTip);
  await tablet.until("every branch grows", ({ metamers }) => metamers > followed.metamers);
});

test("a chosen branch is let go by holding elsewhere, by Escape, and when it is gone", async () => {
  const { tablet } = await workshop.stem();
  const onStem = { x: base.x, y: 560 };
  const choose = () => tablet.hold(onStem, "it is chosen", (facts) => facts.bud !== "");
  const { sent } = await tablet.facts();
  await choose();
  await tablet.hold({ x: 980, y: 300 }, "held elsewhere", (facts) => facts.bud === "");
  await choose();
  await tablet.page.keyboard.press("Escape");
  await tablet.until("Escape", (facts) => facts.bud === "");
  expect((await tablet.facts()).sent, "choosing is no command").toBe(sent);
  await choose();
  await tablet.tap("Undo");
  await tablet.until("the stem is gone", (facts) => facts.bud === "" && facts.metamers === 0);
  await tablet.page.getByText("every branch grows again").waitFor();
});

test("a seed is planted where the ground is tapped, and grows", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  const before = await tablet.facts();
  await tablet.take("Plant a seed");
  await tablet.tapAt({ x: 860, y: 790 });
  const planted = await tablet.until("there are two seeds", (facts) => facts.rows === before.rows + 1);
  expect(planted.tool, "for the next one").toBe("seed");
  await tablet.page.keyboard.press("b");
  const seedlings = () => tablet.page.locator(".seedling").count();
  await expect.poll(seedlings).toBe(2);
  await tablet.show("25-two-seeds");
  await tablet.swipe([way({ x: 860, y: 745 }, { x: 860, y: 460 })]);
  expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(5);
  await expect.poll(seedlings).toBe(1);
});

test("what is placed in the scene is seen by all, and moves with the finger", async () => {
  const { tablet, address } = await workshop.fresh(LANDSCAPE);
  const second = await workshop.open(address);
  await tablet.tap("Scene");
  const before = await tablet.photograph("26-bare");
  await tablet.page.getByRole("button", { name: "Box", exact: true }).tap();
  await tablet.until("a box stands", (facts) => facts.obstacles === 1);
  await second.until("the other tablet has it too", (facts) => facts.obstacles === 1);
  const placed = await tablet.photograph("27-box");
  // The workspace beside the panel has its middle farther to the left.
  const right: Box = { x: 535, y: 525, width: 105, height: 100 };
  const left: Box = { x: 200, y: 525, width: 105, height: 100 };
  expect(changed(before, placed, right)).toBeGreaterThan(0.2);
  expect(changed(before, placed, left)).toBeLessThan(0.05);

  const across = tablet.page.getByLabel("Across: value", { exact: true });
  const place = async () => Number((await across.inputValue()).replace("−", "-"));
  const from = await place();
  await tablet.swipe([way({ x: 587, y: 575 }, { x: 252, y: 575 })]);
  const moved = await tablet.untilQuiet();
  expect(moved.metamers, "the finger moved it and drew nothing").toBe(0);
  await expect.poll(place).toBeLessThan(from - 5);
  const dragged = await tablet.photograph("28-box-moved");
  expect(changed(before, dragged, left)).toBeGreaterThan(0.2);
  await tablet.tap("Undo");
  const undone = await tablet.until("moving is undone", (facts) => facts.done === moved.done - 1);
  expect(undone.obstacles).toBe(1);
  await tablet.tap("Undo");
  await second.until("and placing", (facts) => facts.obstacles === 0);
});

test("OB2: another size, or a key held down, is one step back", async () => {
  const { tablet } = await workshop.fresh();
  const { keyboard } = tablet.page;
  await tablet.tap("Scene");
  await tablet.page.getByRole("button", { name: "Box", exact: true }).tap();
  await tablet.until("a box stands", (facts) => facts.obstacles === 1);
  const field = (name: string) => tablet.page.getByLabel(`${name}: value`, { exact: true });
  const measure = async (name: string) => Number(await field(name).inputValue());
  const becomes = (name: string, value: number) =>
    expect.poll(() => measure(name), { message: name }).toBeCloseTo(value);
  const width = await measure("Width");
  await field("Width").fill("9");
  await keyboard.press("Enter");
  await tablet.until("it is another size", (facts) => facts.done === 2);
  await tablet.untilQuiet();
  await tablet.tap("Undo");
  await becomes("Width", width);
  expect((await tablet.untilQuiet()).obstacles, "the box as it was, and no other").toBe(1);
  await tablet.tap("Redo");
  await becomes("Width", 9);

  const up = await measure("Up");
  await field("Up").focus();
  for (let notch = 0; notch < 8; notch++) await keyboard.down("ArrowUp");
  await keyboard.up("ArrowUp");
  await tablet.until("it has gone up", (facts) => facts.done === 3);
  await tablet.untilQuiet();
  expect(await measure("Up")).toBeCloseTo(up + 0.8);
  for (const [name, value] of [
    ["Up", up],
    ["Width", width],
  ] as const) {
    await tablet.tap("Undo");
    await becomes(name, value);
  }
  await tablet.tap("Undo");
  await tablet.until("and placing", (facts) => facts.obstacles === 0);
});

test("parameters are set in the architecture panel, for everyone", async () => {
  const { tablet, address } = await workshop.fresh();
  const second = await workshop.open(address);
  const priority = async (on: Tablet) => {
    await on.tap("Architecture");
    await on.turnTo("Growth");
    await on.page.getByText("How vigor is shared", { exact: true }).tap();
    return on.page.getByRole("radio", { name: "Priority", exact: true });
  };
  const here = await priority(tablet);
  await here.focus();
  await tablet.page.keyboard.press("Space");
  await tablet.page.getByText("Least weight").first().waitFor();
  await tablet.untilQuiet();
  const there = await priority(second);
  await expect.poll(() => there.isChecked()).toBe(true);
});
