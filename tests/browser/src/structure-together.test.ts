import { expect, test } from "vitest";
import { axisOf } from "./design-axis";
import { guestsLink, ownersLink } from "./invitations";
import { LANDSCAPE } from "./screens";
import type { Tablet } from "./tablet";
import { middle, type Point, way } from "./ways";
import { Workshop } from "./workshop";

// People come by links of their own: whoever sits at the machine would be the same person on all pages.
const workshop = Workshop.withItsOwnServer(["--auth"]);

const ANGLE = /^Branching angle/;

const button = (tablet: Tablet, name: string) => tablet.page.getByRole("button", { name, exact: true });
const chosen = (tablet: Tablet) => tablet.page.locator(".structure-bar-name").innerText();
const editor = (tablet: Tablet) => tablet.page.getByRole("group", { name: ANGLE });
const value = (tablet: Tablet) => tablet.page.locator(".structure-value").filter({ has: editor(tablet) });
/** How the chosen branch has its angle. */
const status = (tablet: Tablet) => value(tablet).getAttribute("data-status");
/** The line of what comes of what is said and of what is inherited. */
const result = (tablet: Tablet) => editor(tablet).locator(".structure-result").getAttribute("points");

/** The panel with the parameters of branching alone, for the bonsai that stands. */
async function withPanel(tablet: Tablet): Promise<void> {
  await tablet.page.locator(".structure-bar").waitFor();
  await tablet.press(button(tablet, "Branching"));
}

/** Chooses a branch in the list. */
async function choose(tablet: Tablet, name: string): Promise<void> {
  await tablet.press(tablet.page.locator(".structure-name").filter({ hasText: new RegExp(`^${name}\\d*$`) }));
  await expect.poll(() => chosen(tablet)).toBe(name);
}

/** How many values a branch has of its own, as the list says. */
async function ownValues(tablet: Tablet, name: string): Promise<number> {
  const row = tablet.page.locator(".structure-name").filter({ hasText: new RegExp(`^${name}\\d*$`) });
  return Number((await row.innerText()).replace(name, ""));
}

/** Where the points of the editor are on the glass, once it is in sight. */
async function pointsOf(tablet: Tablet): Promise<readonly Point[]> {
  await editor(tablet).scrollIntoViewIfNeeded();
  await tablet.untilSettled();
  const circles = await editor(tablet).locator("circle").all();
  return Promise.all(circles.map(async (circle) => middle(await tablet.boxOf(circle))));
}

test("UD1: two people shape two branches of a design at once, and each takes back what is his", async () => {
  const ann = await workshop.open(ownersLink(workshop.server, "Ann"), LANDSCAPE);
  await ann.tap("Structure");
  await ann.press(ann.page.getByRole("button", { name: /^chokkan/ }));
  await ann.until("the bonsai stands", ({ metamers }) => metamers > 100);
  const bo = await workshop.open(await guestsLink(ann, "Pine", "Bo"), { ...LANDSCAPE, detail: 0.2 });
  await bo.tap("Structure");
  await Promise.all([withPanel(ann), withPanel(bo)]);

  // Ann picks at the scale of limbs, a scale deeper, and goes back; Bo takes another limb from the list.
  const stem = await axisOf(ann);
  const [foot, top] = [stem[0] as Point, stem.at(-1) as Point];
  const place = { x: top.x + 0.09 * (foot.y - top.y), y: top.y + 0.62 * (foot.y - top.y) };
  await ann.tapAt(place);
  await expect.poll(() => chosen(ann)).toMatch(/^Limb \d+$/);
  const anns = await chosen(ann);
  await ann.doubleTap(place);
  await expect.poll(() => chosen(ann)).toMatch(/^Branch \d+$/);
  await ann.press(button(ann, "The branch that bears it"));
  await expect.poll(() => chosen(ann)).toBe(anns);
  const bos = anns === "Limb 4" ? "Limb 3" : "Limb 4";
  await choose(bo, bos);

  // The menu of its mark makes a function relative; the limb has by it what it had.
  await ann.press(value(ann).locator(".structure-status"));
  await ann.press(value(ann).getByRole("button", { name: "× Factor" }));
  await expect.poll(() => status(ann)).toBe("factor");
  await editor(ann).locator(".structure-inherited").waitFor({ state: "attached" });
  const relative = await result(ann);

  // While Ann's finger pulls the end of the curve down, Bo's pulls the tip of his limb up.
  const end = (await pointsOf(ann)).at(-1) as Point;
  const tip = bo.page.locator('[data-handle="tip"][data-shown="true"]');
  await tip.waitFor();
  const from = middle(await bo.boxOf(tip));
  await ann.lead([way(end, { x: end.x, y: end.y + 30 }, 6)]);
  await expect.poll(() => editor(ann).locator(".structure-said").textContent()).toMatch(/^at 100 %: ×\d\.\d+ → \d+°$/);
  await ann.showNow("99-structure-together");
  await bo.swipe([way(from, { x: from.x - 20, y: from.y - 50 }, 6)]);
  await expect.poll(() => ownValues(bo, bos)).toBeGreaterThan(0);
  // She sees it with her finger still down.
  await expect.poll(() => ownValues(ann, bos)).toBeGreaterThan(0);
  await ann.touch("touchEnd", []);
  await Promise.all([ann.untilQuiet(), bo.untilQuiet()]);
  const [edited, both] = [await result(ann), (await ann.facts()).metamers];
  expect(edited).not.toBe(relative);
  const bosValues = await ownValues(bo, bos);
  expect(await ownValues(ann, bos)).toBe(bosValues);

  // Bo sees hers, with all three curves.
  await choose(bo, anns);
  await expect.poll(() => status(bo)).toBe("factor");
  await expect.poll(() => result(bo)).toBe(edited);
  expect((await bo.facts()).metamers).toBe(both);

  // Her undo takes back her curve and leaves his tip; his the other way round.
  await ann.tap("Undo");
  await expect.poll(() => result(ann)).toBe(relative);
  await expect.poll(() => result(bo)).toBe(relative);
  expect([await ownValues(ann, bos), await ownValues(bo, bos)]).toEqual([bosValues, bosValues]);
  await bo.tap("Undo");
  await expect.poll(() => ownValues(bo, bos)).toBe(0);
  await expect.poll(() => ownValues(ann, bos)).toBe(0);
  expect([await status(ann), await status(bo)]).toEqual(["factor", "factor"]);
  expect(await result(bo)).toBe(relative);
});
