import type { Page } from "playwright-core";

/**
 * A keyboard on the screen, which browsers without a screen have none of: while a field has the focus, the page sees so
 * much less of itself, in pixels.
 */
export async function withScreenKeyboard(page: Page, height: number): Promise<void> {
  await page.evaluate((height) => {
    const { visualViewport } = globalThis;
    if (!visualViewport) throw new Error("the browser tells of no viewport");
    const isOpen = () => document.activeElement instanceof HTMLTextAreaElement;
    Object.defineProperty(visualViewport, "height", { get: () => innerHeight - (isOpen() ? height : 0) });
    const tell = () => requestAnimationFrame(() => visualViewport.dispatchEvent(new Event("resize")));
    for (const kind of ["focusin", "focusout"]) document.addEventListener(kind, tell);
    tell();
  }, height);
}
