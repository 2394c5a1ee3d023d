import {
  FLOWER_NATURES,
  FLOWER_SALT,
  type FlowerKind,
  FRUIT_NATURES,
  FRUIT_SALT,
  type FruitKind,
  type OrnamentNature,
} from "../../wire/generated";

/** Flowers, or fruits: their kinds, and what keeps them from standing in the same places as the others. */
export interface OrnamentSort<Kind extends string> {
  readonly name: "Flower" | "Fruit";
  readonly salt: number;
  readonly kinds: Record<Exclude<Kind, "none">, OrnamentNature>;
}

export const FLOWERS: OrnamentSort<FlowerKind> = { name: "Flower", salt: FLOWER_SALT, kinds: FLOWER_NATURES };
export const FRUITS: OrnamentSort<FruitKind> = { name: "Fruit", salt: FRUIT_SALT, kinds: FRUIT_NATURES };
