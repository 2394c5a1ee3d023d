import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { Darkroom } from "./picture";
import { theBrowser } from "./shared";

const folder = join(import.meta.dirname, "../../../client/public");
/** `WRITE_ICONS=1` draws the pictures anew, for when the drawing has changed. */
const writes = process.env.WRITE_ICONS === "1";

/** Each picture: its side in pixels, how large the drawing is in it, and whether the ground fills its corners. */
const PICTURES = [
  { file: "icon-180.png", side: 180, share: 1, filled: true },
  { file: "icon-192.png", side: 192, share: 1, filled: false },
  { file: "icon-512.png", side: 512, share: 1, filled: false },
  // A mask may take away all but the middle four fifths.
  { file: "icon-maskable-512.png", side: 512, share: 0.8, filled: true },
] as const;

const GROUND = "#e9efe2";

/** The drawing as a picture, as the browser of the tests paints it. */
async function drawn(browser: Browser, { side, share, filled }: (typeof PICTURES)[number]): Promise<Buffer> {
  const svg = await readFile(join(folder, "icon.svg"), "utf8");
  const page = await browser.newPage({ viewport: { width: side, height: side } });
  await page.setContent(
    `<body style="margin: 0; display: grid; place-items: center; height: 100vh; ${filled ? `background: ${GROUND}` : ""}">
      <div style="width: ${share * side}px; height: ${share * side}px">${svg}</div></body>`,
  );
  // Before its first frame a page has nothing that could be taken.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const picture = await page.screenshot({ omitBackground: true });
  await page.close();
  return picture;
}

describe("icons", () => {
  let browser: Browser;
  let darkroom: Darkroom;
  beforeAll(async () => {
    browser = await theBrowser();
    darkroom = await Darkroom.open(browser);
  });
  afterAll(() => browser.close());

  it.each(PICTURES)("$file shows the drawing of today", async (picture) => {
    const path = join(folder, picture.file);
    const now = await drawn(browser, picture);
    if (writes) await writeFile(path, now);
    const [one, other] = [await darkroom.develop(now), await darkroom.develop(await readFile(path))];
    expect([other.width, other.height]).toEqual([one.width, one.height]);
    const apart = one.pixels.reduce((sum, value, i) => sum + Math.abs(value - other.pixels[i]!), 0) / one.pixels.length;
    expect(apart).toBeLessThan(1);
  });
});
