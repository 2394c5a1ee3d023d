import { BufferAttribute } from "three";

/** Triangles a leaf is drawn with. */
export interface Card {
  /** Across −1 to 1, along 0 to 1, and which of a spray's crossed cards. */
  readonly card: BufferAttribute;
  readonly index: number[];
  readonly triangles: number;
}

/** A grid of so many columns and rows on each of so many cards. */
function cards(count: number, columns: number, rows: number): Card {
  const corners: number[] = [];
  const index: number[] = [];
  for (let which = 0; which < count; which += 1) {
    const first = corners.length / 3;
    for (let row = 0; row <= rows; row += 1) {
      for (let column = 0; column <= columns; column += 1) corners.push((2 * column) / columns - 1, row / rows, which);
    }
    for (let row = 0; row < rows; row += 1) {
      for (let column = 0; column < columns; column += 1) {
        const a = first + row * (columns + 1) + column;
        const c = a + columns + 1;
        index.push(a, a + 1, c, c, a + 1, c + 1);
      }
    }
  }
  return { card: new BufferAttribute(new Float32Array(corners), 3), index, triangles: index.length / 3 };
}

/** From near to far. A blade is folded along its midrib and bowed; far off it is flat. */
export const BLADE_CARDS: readonly [Card, Card, Card] = [cards(1, 2, 4), cards(1, 2, 1), cards(1, 1, 1)];
/** Three cards crossed around the twig, two, and one that turns towards the eye. */
export const SPRAY_CARDS: readonly [Card, Card, Card] = [cards(3, 1, 2), cards(2, 1, 1), cards(1, 1, 1)];

/** Triangles all leaves may have together. */
export const LEAF_TRIANGLES = 850_000;
/** A leaf's pixels above which it is worth the triangles of each level; the shaders flatten it before. */
export const LEVEL_PIXELS = [26, 9] as const;

/** Which of the three levels so many leaves are drawn with, the largest of them this long on the screen. */
export function levelFor(levels: readonly Card[], leaves: number, pixels: number, detailed: boolean): number {
  let level = pixels > LEVEL_PIXELS[0] ? 0 : pixels > LEVEL_PIXELS[1] ? 1 : 2;
  const budget = LEAF_TRIANGLES * (detailed ? 1 : 0.4);
  while (level < 2 && levels[level]!.triangles * leaves > budget) level += 1;
  return level;
}

/** Flowers and fruits are pictures that turn towards the eye. */
export const ORNAMENT_CARDS: Card = cards(1, 1, 1);
/** A sprig is always far enough away for a flat card. */
export const SPRIG_CARD: Card = cards(1, 1, 1);
