import { mkdir } from "node:fs/promises";
import { dirname, join } from "node:path";
import type { Tablet } from "./tablet";

/** Where pictures for the docs lie. */
const docs = join(import.meta.dirname, "../../../docs");
/** Whether they are taken anew. */
export const KEEPING = process.env.REVIEW_PICTURES === "1";

/**
 * A picture of some pages as they are this moment, side by side with who looks at each, for people to look at; something
 * is done just before each is taken.
 */
export async function sideBySide(
  name: string,
  pages: readonly (readonly [who: string, tablet: Tablet])[],
  before = async () => {},
): Promise<void> {
  if (!KEEPING) return;
  const shots = [];
  for (const [who, tablet] of pages) {
    await tablet.untilCome();
    await before();
    // What comes of it is on its way to the others.
    await tablet.page.waitForTimeout(300);
    shots.push({ who, png: (await tablet.page.screenshot({ animations: "disabled" })).toString("base64") });
  }
  const [, first] = pages[0]!;
  const browser = first.page.context().browser();
  if (!browser) throw new Error("there is no browser to put pictures together in");
  const page = await browser.newPage({ viewport: { width: 1600, height: 600 } });
  const figures = shots.map(
    ({ who, png }) => `<figure><figcaption>${who}</figcaption><img src="data:image/png;base64,${png}"></figure>`,
  );
  await page.setContent(`<style>
    body { display: flex; gap: 16px; margin: 16px; width: max-content; background: #e9ece6; font: 600 15px system-ui, sans-serif; color: #33403a }
    figure { margin: 0 } figcaption { margin: 0 0 6px 4px } img { display: block; height: 520px; border-radius: 10px; box-shadow: 0 2px 10px #0003 }
  </style>${figures.join("")}`);
  await page.waitForFunction(() =>
    [...document.images].every(({ complete, naturalWidth }) => complete && naturalWidth > 0),
  );
  const path = join(docs, "review", `${name}.jpg`);
  await mkdir(dirname(path), { recursive: true });
  await page.locator("body").screenshot({ path, type: "jpeg", quality: 78 });
  await page.close();
}
