import { expect, test } from "vitest";
import { misses } from "./hits";
import { withScreenKeyboard } from "./screen-keyboard";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };
const SMALLEST: Screen = { ...PHONE, width: 320, height: 568 };

const button = (tablet: Tablet, name: string | RegExp) => tablet.page.getByRole("button", { name, exact: true });
const area = (tablet: Tablet) => tablet.page.getByRole("textbox", { name: "Text of the grammar" });
const textOf = (tablet: Tablet) => area(tablet).inputValue();

/** Shows one of the parts of the panel. */
async function turnTo(tablet: Tablet, part: "Grammars" | "Text" | "Depth") {
  const tab = tablet.page.getByRole("tab", { name: part, exact: true });
  if ((await tab.count()) === 0) await tablet.tap("Grammars");
  await tablet.press(tab);
  await tablet.page.getByRole("tab", { name: part, exact: true, selected: true }).waitFor();
}

/** Plants what one begins with. */
async function begin(tablet: Tablet) {
  await turnTo(tablet, "Grammars");
  await tablet.press(button(tablet, "Write your own"));
  return tablet.until("it is planted", ({ metamers, pending }) => metamers > 3 && pending === 0);
}

async function write(tablet: Tablet, line: string) {
  await tablet.press(area(tablet));
  await tablet.page.keyboard.press("ControlOrMeta+End");
  await tablet.page.keyboard.type(line);
}

/** Writes over all that stands there. */
async function writeOver(tablet: Tablet, text: string) {
  await tablet.press(area(tablet));
  await tablet.page.keyboard.press("ControlOrMeta+A");
  await tablet.page.keyboard.type(text);
}

test("grammars are loaded when they are opened, and not before", async () => {
  const { tablet } = await workshop.drawn(LANDSCAPE);
  await tablet.photograph("103-grammars-not-loaded");
  const loaded = (part: RegExp) =>
    tablet.page.evaluate(
      (part) => performance.getEntriesByType("resource").filter(({ name }) => new RegExp(part).test(name)).length,
      part.source,
    );
  // That which comes last of all that is loaded beside the first picture.
  await until("everything else has come", async () => (await loaded(/\/settings-sheet-/)) > 0);
  expect(await loaded(/\/(grammars-panel|grammars-of|depth-stepper)-/)).toBe(0);
  await turnTo(tablet, "Text");
  expect(await loaded(/\/grammars-panel-/)).toBe(1);
});

test("what was typed and not planted is a tap away after another grammar, and after the page is loaded again", async () => {
  const { tablet, address } = await workshop.fresh(UPRIGHT);
  const { page } = tablet;
  await begin(tablet);
  await write(tablet, "\nB --> F[");
  await page.locator('.grammar-layer [data-problem="0"]').first().waitFor();
  const mine = await textOf(tablet);

  // The page comes again as it was left.
  await page.reload();
  await tablet.untilReady();
  await turnTo(tablet, "Text");
  await expect.poll(() => textOf(tablet)).toBe(mine);
  expect(await page.getByText(/has planted another text/).count()).toBe(0);

  // Another grammar takes its place, which is said; the text is among those that are not planted.
  await turnTo(tablet, "Grammars");
  await button(tablet, /^My plant ?stands in the editor$/).waitFor();
  await tablet.press(page.locator('[data-grammar="barron-binary"]'));
  await page.getByText("Your text before was put aside.").waitFor();
  await tablet.until("the other one is planted", ({ metamers, pending }) => metamers > 255 && pending === 0);
  const card = button(tablet, /^My plant ?\d+ lines$/);
  await card.waitFor();
  await tablet.show("103-grammar-draft");

  // Also on a page that is opened later.
  const later = await workshop.open(address, UPRIGHT);
  await turnTo(later, "Grammars");
  await later.page.locator('[data-grammar="barron-binary"][aria-pressed="true"]').waitFor();
  expect(await button(later, /^My plant/).count(), "each browser has its own").toBe(0);
  await page.reload();
  await tablet.untilReady();
  await turnTo(tablet, "Grammars");
  await tablet.press(card);
  await expect.poll(() => textOf(tablet)).toBe(mine);
  await write(tablet, "+F]");
  await page.getByText("Planted", { exact: true }).or(button(tablet, /note/)).waitFor();
  await turnTo(tablet, "Grammars");
  expect(await page.getByText("Not planted", { exact: true }).count()).toBe(0);
});

test("a text that grows too large stays in the editor, and is planted as deep as it may", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  const { page } = tablet;
  const before = await begin(tablet);
  const bomb = "title: Bomb\nscale: 0.02\nderivation length: 20\naxiom: F\nF --> F[+F]FFFFFF";
  await writeOver(tablet, bomb);
  await page.getByText(/^The text could not be planted at depth 20: /).waitFor();
  await page.getByText(/The plant before stands, at depth 6\.$/).waitFor();
  expect(await textOf(tablet)).toBe(bomb);
  expect((await tablet.facts()).metamers).toBe(before.metamers);
  await tablet.show("103-grammar-refused");

  await turnTo(tablet, "Depth");
  await page.getByText(/^The text could not be planted at depth 20: /).waitFor();
  await tablet.show("103-grammar-refused-depth");
  const offer = button(tablet, /^Plant it at depth \d+$/);
  const depth = Number(/\d+$/.exec((await offer.textContent()) ?? "")?.[0]);
  expect(depth).toBeLessThan(20);
  await tablet.press(offer);
  await tablet.until("it is planted", ({ metamers, pending }) => metamers !== before.metamers && pending === 0);
  await page.getByRole("heading", { name: "Bomb" }).waitFor();
  await expect.poll(() => page.getByRole("slider", { name: "Depth", exact: true }).inputValue()).toBe(`${depth}`);
  expect(await page.getByText(/could not be planted/).count()).toBe(0);
});

test.each([
  ["a tablet on its side", LANDSCAPE, 380],
  ["a tablet upright", UPRIGHT, 340],
  ["a small phone", { ...PHONE, width: 360, height: 740 }, 300],
  ["the smallest phone", SMALLEST, 250],
] as const)("every control of the editor is hit where it is drawn on %s", async (name, screen, keyboard) => {
  const { tablet } = await workshop.fresh(screen);
  const { page } = tablet;
  const shown = (what: string) => tablet.show(`103-editor-${name.replaceAll(" ", "-")}-${what}`);
  await begin(tablet);
  await write(tablet, "\nB --> F[");
  await page.locator('.grammar-layer [data-problem="0"]').first().waitFor();
  await area(tablet).blur();
  await shown("1");
  const faults = await misses(tablet, "text", ".grammars");
  const labels = page.locator(".grammar-head button");
  const overflows = await labels.evaluateAll(
    (all) => all.filter((one) => one.scrollWidth > one.clientWidth + 1).length,
  );
  expect(overflows, "no label runs out of its button").toBe(0);

  // What explains the signs leaves the text in sight, or is read in its place; signs stand where they stood.
  await tablet.press(button(tablet, "Short reference"));
  const reference = page.getByRole("region", { name: "Short reference" });
  expect((await tablet.boxOf(reference)).height).toBeGreaterThan(100);
  if (screen.width > 600) expect((await tablet.boxOf(page.locator(".grammar-scroll"))).height).toBeGreaterThan(100);
  await shown("2-reference");
  faults.push(...(await misses(tablet, "reference", ".grammars")));
  await tablet.press(button(tablet, "Short reference"));

  // With the keyboard of the screen text and signs are in sight above it.
  await withScreenKeyboard(page, keyboard);
  await tablet.press(area(tablet));
  await page.locator(":root[data-keyboard]").waitFor({ state: "attached" });
  await shown("3-keyboard");
  const signs = await tablet.boxOf(page.locator(".grammar-keys"));
  expect(signs.y + signs.height).toBeLessThanOrEqual(screen.height - keyboard + 1);
  expect((await tablet.boxOf(page.locator(".grammar-scroll"))).height).toBeGreaterThanOrEqual(70);
  faults.push(...(await misses(tablet, "keyboard", ".grammars", false)));
  expect(faults).toEqual([]);
});
