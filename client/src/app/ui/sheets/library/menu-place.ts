/** So far from the edges of the page a menu stands, in pixels. */
const EDGE = 8;

interface Size {
  readonly width: number;
  readonly height: number;
}

/** Where something lies on the page, in pixels. */
interface Place {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** Where the menu of a card stands: below its button, else beside the card or above it, so that one sees whose it is; always on the page. */
export function placeBeside(menu: Size, button: Place, card: Place, page: Size): { left: number; top: number } {
  const within = (at: number, size: number, whole: number) => Math.max(EDGE, Math.min(at, whole - size - EDGE));
  const left = within(button.right - menu.width, menu.width, page.width);
  if (button.bottom + menu.height <= page.height - EDGE) {
    return { left, top: button.bottom };
  }
  const level = within(button.bottom - menu.height, menu.height, page.height);
  if (card.right + menu.width <= page.width - EDGE) {
    return { left: card.right, top: level };
  }
  if (card.left - menu.width >= EDGE) {
    return { left: card.left - menu.width, top: level };
  }
  const above = card.top - menu.height;
  return { left, top: above >= EDGE ? above : within(button.top - menu.height, menu.height, page.height) };
}
