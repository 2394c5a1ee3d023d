import type { LeafTile } from "./leaf-tile";

/** How one kind of flower or fruit is made. */
export interface OrnamentKind {
  /** Half of its width, in its own lengths. */
  readonly reach: number;
  /** −1 hanging, 0 as a leaf stands, 1 upright. */
  readonly hang: number;
  /** How far it turns its face to the eye, 0 to 1; below 0 for a disc that looks where a leaf points. */
  readonly turn: number;
  /** Its stalk, in its own lengths. */
  readonly stalk: number;
  /** How much it shines. */
  readonly gloss: number;
  /** Its second colour in sRGB. */
  readonly second: readonly number[];
  /** One picture of it, with so many texels along each side. */
  paint(random: () => number, side?: number): LeafTile;
}

/** Flowers, or fruits: their kinds, and what keeps them from standing in the same places as the others. */
export interface OrnamentSort<Kind extends string> {
  readonly name: "Flower" | "Fruit";
  readonly salt: number;
  /** How many of a kind stand at a place. */
  readonly together: Record<Kind | "none", number>;
  readonly kinds: Record<Exclude<Kind, "none">, OrnamentKind>;
}
