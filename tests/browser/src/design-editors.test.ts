import { expect, test } from "vitest";
import { axisOf } from "./design-axis";
import { LANDSCAPE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { middle, type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };

const button = (tablet: Tablet, name: string) => tablet.page.getByRole("button", { name, exact: true });
const editorOf = (tablet: Tablet, name: RegExp) => tablet.page.getByRole("group", { name });

/** A tablet with the panel open, and a bonsai begun from its template. */
async function withBonsai(screen: Screen, edits: readonly object[] = []) {
  const { tablet, address } = await workshop.fresh(screen);
  await tablet.tap("Structure");
  await tablet.press(tablet.page.getByRole("button", { name: /^chokkan/ }));
  await tablet.until("the bonsai stands", ({ metamers }) => metamers > 100);
  if (edits.length > 0) {
    const { metamers } = await tablet.untilQuiet();
    await workshop.act(address, [{ kind: "edit_design", edits }]);
    await tablet.until("it has changed", (facts) => facts.metamers !== metamers);
  }
  await tablet.untilQuiet();
  return tablet;
}

/** Where a share of a drawing is on the glass, once it is in sight. */
async function placesOf(tablet: Tablet, name: RegExp): Promise<(x: number, y: number) => Point> {
  const editor = editorOf(tablet, name);
  await editor.scrollIntoViewIfNeeded();
  await tablet.untilSettled();
  const { x, y, width, height } = await tablet.boxOf(editor);
  return (across, down) => ({ x: x + across * width, y: y + down * height });
}

/** Waits for one deed more, and that it is a single one. */
async function oneDeed(tablet: Tablet, what: string, act: () => Promise<void>): Promise<void> {
  const { done } = await tablet.untilQuiet();
  await act();
  await tablet.until(what, (facts) => facts.done === done + 1);
  expect((await tablet.untilQuiet()).done).toBe(done + 1);
}

test.each<[string, Screen]>([
  ["on its side", LANDSCAPE],
  ["upright", UPRIGHT],
])("a finger edits the course, a function and the colours of a limb on a tablet %s", async (name, screen) => {
  const tablet = await withBonsai(screen);
  const shown = (what: string) => tablet.show(`99-editors-${name.replaceAll(" ", "-")}-${what}`);
  await tablet.press(button(tablet, "Limb 3"));

  // Its course is what all limbs have: four points. A tap and a drag make a fifth, in one deed.
  const points = (editor: RegExp) => editorOf(tablet, editor).locator("circle").count();
  await expect.poll(() => points(/^Course/)).toBe(4);
  const course = await placesOf(tablet, /^Course/);
  await oneDeed(tablet, "the axis is bent", () => tablet.swipe([way(course(0.35, 0.42), course(0.15, 0.42), 6)]));
  await expect.poll(() => points(/^Course/)).toBe(5);
  await shown("course");

  // Pulled out of the drawing it is gone again, and so is what was said.
  await tablet.press(button(tablet, "Take the point away").first());
  await expect.poll(() => points(/^Course/)).toBe(4);
  await tablet.tap("Undo");
  await expect.poll(() => points(/^Course/)).toBe(5);
  const again = await placesOf(tablet, /^Course/);
  const pulled = middle(
    await tablet.boxOf(
      editorOf(tablet, /^Course/)
        .locator("circle")
        .nth(2),
    ),
  );
  await oneDeed(tablet, "a point is pulled out", () => tablet.swipe([way(pulled, again(0.2, -0.4), 8)]));
  await expect.poll(() => points(/^Course/)).toBe(4);

  // A touch that moves nothing says nothing; a second finger lets a drag be undone.
  const { done } = await tablet.untilQuiet();
  const angle = await placesOf(tablet, /^Branching angle/);
  await tablet.tapAt(angle(0.06, 0.5));
  await tablet.touch("touchStart", [angle(0.5, 0.4)]);
  await tablet.touch("touchMove", [angle(0.5, 0.2)]);
  await tablet.touch("touchMove", [angle(0.5, 0.15)]);
  await tablet.touch("touchStart", [angle(0.5, 0.15), angle(0.8, 0.8)]);
  await tablet.touch("touchEnd", []);
  expect((await tablet.untilQuiet()).done).toBe(done);

  // Relative, the inherited curve, what is said and what comes of both are seen at once.
  const value = tablet.page.locator(".structure-value").filter({ has: editorOf(tablet, /^Branching angle/) });
  await tablet.press(value.locator(".structure-status"));
  await oneDeed(tablet, "it is a factor", () => tablet.press(value.getByRole("button", { name: "× Factor" })));
  await value.locator("polyline.structure-inherited").waitFor({ state: "attached" });
  const factor = await placesOf(tablet, /^Branching angle/);
  await oneDeed(tablet, "the factor falls", () => tablet.swipe([way(factor(0.06, 0.5), factor(0.06, 0.75), 6)]));
  await value.locator("polyline.structure-local").waitFor({ state: "attached" });
  await shown("relative");

  // Colours.
  const dye = tablet.page.getByRole("group", { name: "Bark", exact: true }).getByRole("button", { name: "Redder" });
  await dye.scrollIntoViewIfNeeded();
  await tablet.untilSettled();
  await oneDeed(tablet, "the bark is dyed", () => tablet.press(dye));
  await expect.poll(() => dye.getAttribute("aria-pressed")).toBe("true");
  await shown("colours");
});

test("the list unfolds to every order, and shows a part of very many", async () => {
  const dense = {
    own: [
      [0, 60],
      [1, 60],
    ],
  };
  const tablet = await withBonsai(LANDSCAPE, [{ edit: "set", of: "/", key: "density", value: dense }]);
  const items = tablet.page.locator(".structure-tree > li > ul > li");
  await expect.poll(() => items.count()).toBe(25);
  const more = tablet.page.getByRole("button", { name: /^24 of \d+ shown/ });
  await tablet.press(more);
  await expect.poll(() => items.count()).toBeGreaterThan(40);

  await tablet.press(button(tablet, "Unfold Limb 2"));
  const limb = items.filter({ has: button(tablet, "Fold Limb 2") });
  await tablet.press(limb.getByRole("button", { name: /^Unfold Branch/ }).first());
  // Its branches were asked for, and cannot bear others.
  const twigs = limb.locator(":scope > ul > li > ul > li");
  await expect.poll(() => twigs.count()).toBeGreaterThan(1);
  expect(await twigs.locator("button.structure-fold").count()).toBe(0);
  await tablet.press(twigs.locator(".structure-name").first());
  await expect.poll(() => tablet.page.locator(".structure-way button").count()).toBe(4);
  await tablet.show("99-editors-list");
});

test("a course that is drawn lies where the finger went, and handles that cannot be hit are counted", async () => {
  const tablet = await withBonsai(LANDSCAPE);
  await tablet.press(button(tablet, "Limb 4"));
  await tablet.press(tablet.page.locator(".structure-bar-groups").getByRole("button", { name: "Axis" }));
  await tablet.page.locator('[data-handle="new-0"]').first().waitFor({ state: "attached" });
  await tablet.untilStill();
  const before = await axisOf(tablet);
  const [base, tip] = [before[0] as Point, before.at(-1) as Point];
  // From its base in a high arch to a place beyond its tip.
  const drawn = Array.from({ length: 13 }, (_, at) => {
    const share = at / 12;
    return {
      x: base.x + 1.2 * (tip.x - base.x) * share,
      y: base.y + (tip.y - base.y) * share - 90 * Math.sin(Math.PI * share),
    };
  });
  await tablet.press(button(tablet, "Draw course"));
  await tablet.show("99-editors-draw");
  await oneDeed(tablet, "the axis is drawn", () => tablet.swipe([drawn]));
  await tablet.show("99-editors-drawn");
  const after = await axisOf(tablet);
  const off = drawn.map((place) => Math.min(...after.map(({ x, y }) => Math.hypot(x - place.x, y - place.y))));
  expect(Math.max(...off)).toBeLessThan(16);

  // A branch of a limb is too small for its handles from here.
  await tablet.press(tablet.page.locator(".structure-bar-groups").getByRole("button", { name: "Outline" }));
  await tablet.press(button(tablet, "Unfold Limb 4"));
  await tablet.press(tablet.page.getByRole("button", { name: /^Branch \d+$/ }).last());
  const hidden = tablet.page.getByRole("button", { name: /^\d+ more: come nearer/ });
  await hidden.waitFor();
  await tablet.untilSettled();
  const count = async () => ((await hidden.count()) > 0 ? Number.parseInt(await hidden.innerText(), 10) : 0);
  const far = await count();
  await tablet.show("99-editors-hidden");
  await tablet.press(hidden);
  await expect.poll(count).toBeLessThan(far);
  await tablet.show("99-editors-near");
});
