import type { Page } from "playwright-core";
import { type PrintedPage, printedPages } from "./printed";

/** A4, in points. */
const A4 = { width: 595, height: 842 };

/** A summary of comments on paper. */
export interface Paper {
  readonly pdf: Buffer;
  readonly pages: readonly PrintedPage[];
  /** What is on no page of what the summary shows on the screen, and what is cut off. */
  readonly faults: readonly string[];
}

/** Prints a summary as it wants to be printed. */
export async function print(summary: Page): Promise<Paper> {
  const words = await summary.locator("h1, h2, p, strong, .when").allInnerTexts();
  const pictures = await summary.locator("img").evaluateAll(async (all) => {
    const images = all as HTMLImageElement[];
    await Promise.all(images.map((image) => image.decode()));
    return images.map(({ naturalWidth, naturalHeight }) => naturalWidth / naturalHeight);
  });
  const pdf = await summary.pdf({ preferCSSPageSize: true });
  const pages = printedPages(pdf);
  const faults = pages.flatMap(({ cut }, i) => cut.map((what) => `page ${i + 1}: ${what}`));
  const text = pages.map(({ text }) => text).join("");
  for (const sentence of words) {
    // A sentence may go on on the next page.
    if (!text.includes(bare(sentence))) faults.push(`on no page: ${sentence}`);
  }
  const drawn = pages.flatMap(({ pictures }) => pictures);
  if (drawn.length !== pictures.length) faults.push(`${drawn.length} pictures of ${pictures.length}`);
  for (const [i, { left, right, bottom, top }] of drawn.entries()) {
    const proportions = (right - left) / (top - bottom);
    if (Math.abs(proportions / (pictures[i] ?? 0) - 1) > 0.02) faults.push(`picture ${i + 1} is out of proportion`);
  }
  for (const { size } of pages) {
    const isA4 = Math.abs(size.right - A4.width) < 2 && Math.abs(size.top - A4.height) < 2;
    if (!isA4) faults.push(`it is no A4: ${JSON.stringify(size)}`);
  }
  return { pdf, pages, faults };
}

/** The words alone, as paper has them. */
function bare(text: string): string {
  return text.normalize("NFKC").replace(/\s/g, "");
}
