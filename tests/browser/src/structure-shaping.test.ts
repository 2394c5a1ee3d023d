import { expect, test } from "vitest";
import { axisOf } from "./design-axis";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };

const button = (tablet: Tablet, name: string) => tablet.page.getByRole("button", { name, exact: true });
const chosen = (tablet: Tablet) => tablet.page.locator(".structure-bar-name").innerText();
const handle = (tablet: Tablet, id: string) => tablet.page.locator(`[data-handle="${id}"][data-shown="true"]`);

async function middleOf(tablet: Tablet, id: string) {
  await handle(tablet, id).waitFor();
  const box = await tablet.boxOf(handle(tablet, id));
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** A tablet on which a bonsai stands that was begun from its template, with the panel out of the way. */
async function withBonsai(screen: Screen) {
  const { tablet } = await workshop.fresh(screen);
  await tablet.tap("Structure");
  await tablet.press(tablet.page.getByRole("button", { name: /^chokkan/ }));
  await tablet.until("the bonsai stands", ({ metamers }) => metamers > 100);
  await tablet.page.locator(".structure-bar").waitFor();
  return tablet;
}

test.each<[string, Screen]>([
  ["on its side", LANDSCAPE],
  ["upright", UPRIGHT],
  ["on a phone", PHONE],
])("a finger finds its way through the shells and shapes a limb, %s", async (name, screen) => {
  const tablet = await withBonsai(screen);
  const shown = (what: string) => tablet.show(`99-shaping-${name.replaceAll(" ", "-")}-${what}`);
  await shown("plant");

  // A tap on a limb chooses it, in the picture and in the list alike.
  const canvas = await tablet.boxOf(tablet.page.locator("#workspace"));
  const stem = await axisOf(tablet);
  const [foot, top] = [stem[0] as Point, stem.at(-1) as Point];
  await tablet.tapAt({ x: top.x + 0.09 * (foot.y - top.y), y: top.y + 0.62 * (foot.y - top.y) });
  await expect.poll(() => chosen(tablet)).toMatch(/^(Limb|lowest)/);
  const limb = await chosen(tablet);
  await expect.poll(() => tablet.page.locator(".structure-name[aria-pressed=true] span").innerText()).toBe(limb);
  await shown("limb");
  if (screen === PHONE) {
    // There is no room for both; shaping goes on without the panel.
    await tablet.press(tablet.page.locator(".drawer header button"));
    await tablet.page.locator(".drawer").waitFor({ state: "detached" });
    await shown("without-panel");
  }

  // Its tip goes with the finger; one drag is one deed.
  const before = (await tablet.facts()).done;
  const from = await middleOf(tablet, "tip");
  await tablet.swipe([way(from, { x: from.x - 30, y: from.y - 60 }, 8)]);
  await tablet.until("one deed more is done", ({ done }) => done === before + 1);
  await tablet.untilQuiet();
  await shown("aimed");
  // Where it lay beside the picture of a phone it stood at its edge, and has not come in.
  const to = await middleOf(tablet, "tip");
  expect(Math.abs(to.y - from.y + 60)).toBeLessThan(12);
  expect(to.x).toBeLessThanOrEqual(from.x);
  await tablet.tap("Undo");
  await tablet.until("it is taken back", ({ done }) => done === before);
  await expect
    .poll(async () => {
      const back = await middleOf(tablet, "tip");
      return Math.hypot(back.x - from.x, back.y - from.y);
    })
    .toBeLessThan(3);

  // Its outline becomes wider, and its axis gets a point.
  await tablet.press(button(tablet, "Outline"));
  await shown("outline");
  await tablet.press(button(tablet, "Axis"));
  const add = await middleOf(tablet, "new-0");
  await tablet.swipe([way(add, { x: add.x, y: add.y - 40 }, 6)]);
  await tablet.until("the axis is bent", ({ done }) => done === before + 1);
  await tablet.untilQuiet();
  await shown("axis");

  // A second finger lets everything be as it was.
  const held = await middleOf(tablet, "new-0");
  await tablet.touch("touchStart", [held]);
  await tablet.touch("touchMove", [{ x: held.x + 20, y: held.y + 30 }]);
  await tablet.touch("touchMove", [{ x: held.x + 30, y: held.y + 50 }]);
  await tablet.page.locator(".structure-readout").waitFor();
  await tablet.touch("touchStart", [
    { x: held.x + 30, y: held.y + 50 },
    { x: canvas.x + 60, y: canvas.y + canvas.height / 2 },
  ]);
  await tablet.page.locator(".structure-readout").waitFor({ state: "detached" });
  await tablet.touch("touchEnd", []);
  await tablet.untilQuiet();
  expect((await tablet.facts()).done).toBe(before + 1);

  // Up again, and out.
  await tablet.press(button(tablet, "The branch that bears it"));
  await expect.poll(() => chosen(tablet)).toBe("The plant");
  await tablet.press(button(tablet, "Done"));
  await tablet.page.locator(".structure-bar").waitFor({ state: "detached" });
});

test("a finger draws the outline of the whole plant", async () => {
  const tablet = await withBonsai(LANDSCAPE);
  const { done, metamers } = await tablet.untilQuiet();
  const tip = await middleOf(tablet, "tip");
  await tablet.press(button(tablet, "Draw"));
  const places = [
    [0, 30],
    [60, 60],
    [130, 130],
    [150, 220],
    [120, 300],
    [0, 340],
    [-120, 300],
    [-150, 220],
    [-130, 130],
    [-60, 60],
    [0, 30],
  ];
  await tablet.touch("touchStart", [{ x: tip.x, y: tip.y + 30 }]);
  for (const [x = 0, y = 0] of places) {
    await tablet.touch("touchMove", [{ x: tip.x + x, y: tip.y + y }]);
    await tablet.frames();
  }
  await tablet.showNow("99-shaping-draws");
  await tablet.touch("touchEnd", []);
  await tablet.until("one deed more is done", (facts) => facts.done === done + 1);
  const drawn = await tablet.untilQuiet();
  expect(drawn.metamers).not.toBe(metamers);
  // What was drawn can be changed by its handles.
  await handle(tablet, "side-0").waitFor();
  await tablet.show("99-shaping-drawn");
  await tablet.tap("Undo");
  await tablet.until("it is taken back", (facts) => facts.metamers === metamers);
});
