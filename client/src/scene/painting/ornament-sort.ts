import type { OrnamentNature } from "../../wire/generated";
import type { LeafTile } from "./leaf-tile";

/** How one kind of flower or fruit is made. */
export interface OrnamentKind extends OrnamentNature {
  /** One picture of it, with so many texels along each side. */
  paint(random: () => number, side?: number): LeafTile;
}

/** Flowers, or fruits: their kinds, and what keeps them from standing in the same places as the others. */
export interface OrnamentSort<Kind extends string> {
  readonly name: "Flower" | "Fruit";
  readonly salt: number;
  readonly kinds: Record<Exclude<Kind, "none">, OrnamentKind>;
}
