import { until } from "./server";
import type { Tab, Tablet } from "./tablet";
import { loop, type Point, way } from "./ways";
import type { Stem } from "./workshop";

export const PANELS = ["Architecture", "Brush", "Leaves", "Branches", "Background", "Scene"];
export const SHEETS = ["Save", "Library", "Share", "Download", "Settings", "Help"];

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
  if (!(await shown.isVisible())) await press(tablet, panel);
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

/** So many touches a finger makes on its way where only what stands beside it is looked at. */
const TOUCHES = 8;

/** Puts each tool to work on a stem, beginning with the brush, and stops on the way to look. */
export async function atWork({ tablet, at }: Stem, look: (where: string) => Promise<void>): Promise<void> {
  const { page } = tablet;
  const escaped = async (where: string) => {
    await look(where);
    await page.keyboard.press("Escape");
  };
  await under(tablet, way(at(0, 130), at(203, 230), TOUCHES), () => look("a stroke under way"));
  await tablet.untilQuiet();

  await tablet.take("Lasso");
  const middle = at(203, 400);
  const radius = at(293, 400).x - middle.x;
  const outline = loop(middle, { x: radius, y: radius }, 2 * TOUCHES).slice(0, 1.5 * TOUCHES);
  await under(tablet, outline, () => escaped("an outline under way"));
  await tablet.take("Plant a seed");
  await look("Plant a seed");

  await tablet.take("Bend");
  await tablet.tapAt(at(0, 150));
  await page.getByLabel("Let go of the base").waitFor();
  await under(tablet, way(at(0, 310), at(123, 270), TOUCHES), () => look("a bend under way"));
  await tablet.untilQuiet();
  await tablet.tap("Undo");
  await tablet.untilQuiet();

  await tablet.take("Width");
  await look("Width");
  await tablet.tapAt(at(0, 170));
  await page.getByLabel("Diameter in internodes").waitFor();
  await look("a width chosen");

  await tablet.take("Prune");
  await page.getByLabel("Darker than: value").fill("60");
  await page.keyboard.press("Enter");
  await page.locator(".tool-options .danger").waitFor();
  // On a phone what is about to be cut hides the other options.
  for (const name of await page.locator(".tool-options .field-name:visible").all()) await tablet.press(name);
  await look("what is dark");
  await tablet.tap("Reset Darker than");
  const across = way(at(103, 310), at(163, 130), TOUCHES);
  await under(tablet, across, () => escaped("a cut under way"));
  await page.getByLabel("What if?", { exact: true }).check();
  await tablet.swipe([across]);
  await page.getByRole("region", { name: "Prediction" }).waitFor();
  await tablet.press(page.locator(".prediction .field-name"));
  await look("a prediction");
  await tablet.press(page.getByRole("button", { name: "Discard" }));
  // The view goes back to where it was.
  await tablet.until("it is discarded", ({ ghost }) => ghost === "");
  await tablet.untilStill();

  await tablet.take("Branch");
  await tablet.tapAt(at(148, 208));
  await page.getByRole("toolbar", { name: "This branch" }).waitFor();
  await look("a branch held");
  await tablet.press(page.getByRole("button", { name: "Copy" }));
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
  await tablet.pressInBar(tablet.page.locator(".tool-bar").getByRole("button", { name, exact: true }));
}
