import { until } from "./server";
import { loop, type Point, type Tablet, way } from "./tablet";
import { SEED } from "./workshop";

export const PANELS = ["Architecture", "Brush", "Leaves", "Branches", "Background", "Scene"];
export const SHEETS = ["Save", "Library", "Share", "Settings", "Help"];

/** Has every section of the panel unfolded. */
export async function folded(tablet: Tablet): Promise<void> {
  const closed = tablet.page.locator(".drawer details:not([open])");
  await tablet.page.evaluate(() => {
    for (const summary of document.querySelectorAll<HTMLElement>(".drawer details:not([open]) > summary")) {
      summary.click();
    }
  });
  await until("every section is open", async () => (await closed.count()) === 0);
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

  await tablet.tap("Lasso");
  const outline = loop({ x: 800, y: 350 }, { x: 90, y: 90 }).slice(0, 30);
  await under(tablet, outline, () => escaped("an outline under way"));
  await tablet.tap("Plant a seed");
  await look("Plant a seed");

  await tablet.tap("Bend");
  await tablet.hold(onStem(600), 30);
  await page.getByLabel("Let go of the base").waitFor();
  await under(tablet, way(onStem(440), { x: 720, y: 480 }), () => look("a bend under way"));
  await tablet.untilQuiet();
  await tablet.tap("Undo");
  await tablet.untilQuiet();

  await tablet.tap("Width");
  await look("Width");
  await tablet.hold(onStem(580), 30);
  await page.getByLabel("Diameter in internodes").waitFor();
  await look("a width chosen");

  await tablet.tap("Prune");
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

  await tablet.tap("Branch");
  await tablet.hold({ x: 745, y: 542 }, 30);
  await page.getByRole("toolbar", { name: "This branch" }).waitFor();
  await look("a branch held");
  await page.getByRole("button", { name: "Copy" }).tap();
  await look("a copy to be placed");
}

/** One finger drawn along a way; what it does is looked at before it lifts. */
async function under(tablet: Tablet, path: readonly Point[], look: () => Promise<void>): Promise<void> {
  for (const [i, point] of path.entries()) {
    await tablet.touch(i === 0 ? "touchStart" : "touchMove", [point]);
    await tablet.page.waitForTimeout(16);
  }
  await look();
  await tablet.touch("touchEnd", []);
}
