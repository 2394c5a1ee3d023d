import { describe, expect, it } from "vitest";
import { placeBeside } from "./menu-place";

const tablet = { width: 1194, height: 834 };
const menu = { width: 220, height: 300 };
/** A card of a library, and its button at its lower right corner. */
const cardAt = (left: number, top: number) => {
  const card = { left, right: left + 240, top, bottom: top + 290 };
  return { card, button: { left: card.right - 44, right: card.right, top: card.bottom - 44, bottom: card.bottom } };
};

/** Whether a menu that stands there covers anything of the card. */
const covers = ({ left, top }: { left: number; top: number }, card: ReturnType<typeof cardAt>["card"]) =>
  left < card.right && left + menu.width > card.left && top < card.bottom && top + menu.height > card.top;

describe("the menu of a card", () => {
  it("stands below its button where there is room", () => {
    const { card, button } = cardAt(300, 100);
    expect(placeBeside(menu, button, card, tablet)).toEqual({ left: 320, top: 390 });
  });

  it("covers no card, wherever on a tablet that is", () => {
    for (let left = 10; left <= 940; left += 30) {
      for (let top = 0; top <= 540; top += 30) {
        const { card, button } = cardAt(left, top);
        const place = placeBeside(menu, button, card, tablet);
        expect(covers(place, card), `${left} ${top}`).toBe(false);
        expect(place.left).toBeGreaterThanOrEqual(8);
        expect(place.left + menu.width).toBeLessThanOrEqual(tablet.width - 8);
        expect(place.top).toBeGreaterThanOrEqual(8);
        expect(place.top + menu.height).toBeLessThanOrEqual(tablet.height - 8);
      }
    }
  });

  it("is on the page all the same where nothing else is", () => {
    const low = { width: 360, height: 320 };
    const { card, button } = cardAt(60, 20);
    const { left, top } = placeBeside(menu, button, card, low);
    expect([left >= 8, top >= 8, left + menu.width <= 352, top + menu.height <= 312]).toEqual([true, true, true, true]);
  });
});
