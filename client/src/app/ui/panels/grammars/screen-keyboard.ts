/** What covers less of the screen than this, in pixels, is no keyboard but a bar of the browser's. */
const LEAST = 120;

/** How much of the page's foot the keyboard on the screen covers, in pixels. */
export function coveredBy(
  page: { readonly innerHeight: number },
  seen: { readonly height: number; readonly offsetTop: number; readonly scale: number },
): number {
  // Whoever has zoomed into the page sees less of it without any keyboard.
  const covered = seen.scale > 1.01 ? 0 : page.innerHeight - seen.height - seen.offsetTop;
  return covered < LEAST ? 0 : Math.round(covered);
}

/** Keeps the page above the keyboard on the screen from now on, so that the tree and the text stay in sight. */
export function followKeyboard(): () => void {
  const { visualViewport, document } = globalThis;
  const root = document.documentElement;
  const follow = () => {
    const covered = visualViewport ? coveredBy(globalThis, visualViewport) : 0;
    root.style.setProperty("--keyboard", `${covered}px`);
    root.toggleAttribute("data-keyboard", covered > 0);
  };
  visualViewport?.addEventListener("resize", follow);
  visualViewport?.addEventListener("scroll", follow);
  follow();
  return () => {
    visualViewport?.removeEventListener("resize", follow);
    visualViewport?.removeEventListener("scroll", follow);
    root.style.removeProperty("--keyboard");
    root.removeAttribute("data-keyboard");
  };
}
