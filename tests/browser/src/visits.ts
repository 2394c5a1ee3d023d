import type { Locator } from "playwright-core";
import { until } from "./server";
import type { Tab, Tablet } from "./tablet";
import { loop, type Point, way } from "./ways";
import { SEED } from "./workshop";

export const PANELS = ["Architecture", "Brush", "Leaves", "Branches", "Background", "Scene"];
export const SHEETS = ["Save", "Library", "Share", "Download", "Settings", "Help"];

/** Where the seedling stands on the glass. */
export async function seedling(tablet: Tablet): Promise<Point> {
  const { x, y, width, height } = await tablet.boxOf(tablet.page.locator(".seedling").first());
  return { x: x + width / 2, y: y + 0.9 * height };
}

/** Pulls down a panel. */
export async function pullDown(tablet: Tablet, panel: string): Promise<void> {
  await tablet.tap(panel);
  await tablet.page.getByRole("region", { name: panel, exact: true }).waitFor();
}

/** Has every section of the panel unfolded. */
export async function unfolded(tablet: Tablet): Promise<void> {
  const closed = tablet.page.locator(".drawer details:not([open])");
  await tablet.page.evaluate(() => {
    for (const summary of document.querySelectorAll<HTMLElement>(".drawer details:not([open]) > summary")) {
      summary.click();
    }
  });
  await until("every section is open", async () => (await closed.count()) === 0);
}

/** A panel with all that can be in it. */
export interface Part {
  readonly panel: string;
  readonly tab?: Tab;
  /** What is picked so that more controls appear. */
  readonly picks?: readonly string[];
  /** How many controls there are at least. */
  readonly least: number;
}

export const PARTS: readonly Part[] = [
  { panel: "Architecture", tab: "Form", least: 14 },
  { panel: "Architecture", tab: "Growth", least: 16 },
  { panel: "Architecture", tab: "Growth", picks: ["Priority"], least: 16 },
  { panel: "Brush", least: 6 },
  { panel: "Leaves", picks: ["Rosette", "Cone"], least: 19 },
  { panel: "Branches", least: 8 },
  { panel: "Background", picks: ["Studio"], least: 7 },
];

/** Pulls down a panel with all its sections open and everything in it that depends on a choice. */
export async function openPart(tablet: Tablet, { panel, tab, picks = [] }: Part): Promise<void> {
  const { page } = tablet;
  const shown = page.getByRole("region", { name: panel, exact: true });
  if (!(await shown.isVisible())) await page.getByRole("button", { name: panel, exact: true }).first().click();
  await shown.waitFor();
  if (tab) await tablet.turnTo(tab);
  await unfolded(tablet);
  for (const pick of picks) {
    await page.getByRole("radio", { name: pick, exact: true }).click();
    await page.getByRole("radio", { name: pick, exact: true, checked: true }).waitFor();
    await unfolded(tablet);
  }
  await tablet.untilSettled();
}

/** A place on the stem that was sketched. */
const onStem = (y: number): Point => ({ x: SEED.x, y });

/** Where a limb ends that is drawn from it, and a way across that limb. */
const LIMB: Point = { x: 800, y: 520 };
const ACROSS: readonly Point[] = way({ x: 700, y: 440 }, { x: 760, y: 620 });

/** Puts each tool to work on a stem, beginning with the brush, and stops on the way to look. */
export async function atWork(tablet: Tablet, look: (where: string) => Promise<void>): Promise<void> {
  const { page } = tablet;
  const escaped = async (where: string) => {
    await look(where);
    await page.keyboard.press("Escape");
  };
  await under(tablet, way(onStem(620), LIMB), () => look("a stroke under way"));
  await tablet.untilQuiet();

  await tablet.take("Lasso");
  const outline = loop({ x: 800, y: 350 }, { x: 90, y: 90 }).slice(0, 30);
  await under(tablet, outline, () => escaped("an outline under way"));
  await tablet.take("Plant a seed");
  await look("Plant a seed");

  await tablet.take("Bend");
  await tablet.tapAt(onStem(600));
  await page.getByLabel("Let go of the base").waitFor();
  await under(tablet, way(onStem(440), { x: 720, y: 480 }), () => look("a bend under way"));
  await tablet.untilQuiet();
  await tablet.tap("Undo");
  await tablet.untilQuiet();

  await tablet.take("Width");
  await look("Width");
  await tablet.tapAt(onStem(580));
  await page.getByLabel("Diameter in internodes").waitFor();
  await look("a width chosen");

  await tablet.take("Prune");
  await page.getByLabel("Darker than: value").fill("60");
  await page.keyboard.press("Enter");
  await page.locator(".tool-options .danger").waitFor();
  for (const name of await page.locator(".tool-options .field-name").all()) await name.tap();
  await look("what is dark");
  await page.getByLabel("Reset Darker than").tap();
  await under(tablet, ACROSS, () => escaped("a cut under way"));
  await page.getByLabel("What if?", { exact: true }).check();
  await tablet.swipe([ACROSS]);
  await page.getByRole("region", { name: "Prediction" }).waitFor();
  await page.locator(".prediction .field-name").tap();
  await look("a prediction");
  await page.getByRole("button", { name: "Discard" }).tap();
  // The view goes back to where it was.
  await tablet.until("it is discarded", ({ ghost }) => ghost === "");
  await tablet.untilStill();

  await tablet.take("Branch");
  await tablet.tapAt({ x: 745, y: 542 });
  await page.getByRole("toolbar", { name: "This branch" }).waitFor();
  await look("a branch held");
  await page.getByRole("button", { name: "Copy" }).tap();
  await look("a copy to be placed");
}

/** One finger drawn along a way; what it does is looked at before it lifts. */
async function under(tablet: Tablet, path: readonly Point[], look: () => Promise<void>): Promise<void> {
  await tablet.lead([path]);
  await look();
  await tablet.touch("touchEnd", []);
}

/** Presses a button of the tool bar, in its menu where it is folded. */
export async function press(tablet: Tablet, name: string): Promise<void> {
  const push = (button: Locator) => (tablet.touches ? button.tap() : button.click());
  const button = tablet.page.locator(".tool-bar").getByRole("button", { name, exact: true });
  if ((await button.count()) === 0) await push(tablet.page.getByRole("button", { name: "More", exact: true }));
  await push(button);
}
