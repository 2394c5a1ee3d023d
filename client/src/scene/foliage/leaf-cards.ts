import { BufferAttribute } from "three";

/** Triangles a leaf is drawn with. */
export interface Card {
  /** Across −1 to 1, along 0 to 1, and which of a spray's crossed cards, with `BLADE_STEP` more for each further blade. */
  readonly card: BufferAttribute;
  readonly index: number[];
  readonly triangles: number;
}

/** What tells the blades of a leaf apart in a card's last number; a spray has fewer cards. */
export const BLADE_STEP = 4;

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

/** Triangles that leaves may have together now. */
const budgetFor = (detailed: boolean) => LEAF_TRIANGLES * (detailed ? 1 : 0.4);

/** So many blades of each leaf, each on such cards. */
export function divided(levels: readonly [Card, Card, Card], blades: number): readonly [Card, Card, Card] {
  return levels.map((card) => repeated(card, blades)) as [Card, Card, Card];
}

function repeated({ card, index, triangles }: Card, blades: number): Card {
  const numbers = new Float32Array(blades * card.array.length);
  const all: number[] = [];
  for (let blade = 0; blade < blades; blade += 1) {
    for (let i = 0; i < card.array.length; i += 1) {
      numbers[blade * card.array.length + i] = card.array[i]! + (i % 3 === 2 ? BLADE_STEP * blade : 0);
    }
    for (const corner of index) all.push(blade * card.count + corner);
  }
  return { card: new BufferAttribute(numbers, 3), index: all, triangles: blades * triangles };
}

/** Of the blades that each of so many leaves is divided into, how many there are triangles for. */
export function bladesFor(levels: readonly Card[], leaves: number, blades: number, detailed: boolean): number {
  const least = levels[levels.length - 1]!.triangles * Math.max(1, leaves);
  return Math.max(1, Math.min(blades, Math.floor(budgetFor(detailed) / least)));
}

/** Which of the three levels so many leaves are drawn with, the largest of them this long on the screen. */
export function levelFor(levels: readonly Card[], leaves: number, pixels: number, detailed: boolean): number {
  let level = pixels > LEVEL_PIXELS[0] ? 0 : pixels > LEVEL_PIXELS[1] ? 1 : 2;
  const budget = budgetFor(detailed);
  while (level < 2 && levels[level]!.triangles * leaves > budget) level += 1;
  return level;
}

/** Flowers and fruits are pictures that turn towards the eye. */
export const ORNAMENT_CARDS: Card = cards(1, 1, 1);
/** A sprig is always far enough away for a flat card. */
export const SPRIG_CARD: Card = cards(1, 1, 1);
