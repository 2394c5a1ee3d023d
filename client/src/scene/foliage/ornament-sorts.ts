import {
  FLOWER_NATURES,
  FLOWER_SALT,
  type FlowerKind,
  FRUIT_NATURES,
  FRUIT_SALT,
  type FruitKind,
  GIVEN_FLOWER,
  GIVEN_FRUIT,
  type OrnamentNature,
} from "../../wire/generated";
import { OrganKind } from "./organs";

/** Flowers, or fruits: their kinds, and what keeps them from standing in the same places as the others. */
export interface OrnamentSort<Kind extends string> {
  readonly name: "Flower" | "Fruit";
  readonly salt: number;
  readonly kinds: Record<Exclude<Kind, "none">, OrnamentNature>;
  /** What it is among the organs that a row is given. */
  readonly organ: OrganKind;
  /** The kind that those show where the look has none. */
  readonly given: Exclude<Kind, "none">;
}

export const FLOWERS: OrnamentSort<FlowerKind> = {
  name: "Flower",
  salt: FLOWER_SALT,
  kinds: FLOWER_NATURES,
  organ: OrganKind.Flower,
  given: GIVEN_FLOWER,
};
export const FRUITS: OrnamentSort<FruitKind> = {
  name: "Fruit",
  salt: FRUIT_SALT,
  kinds: FRUIT_NATURES,
  organ: OrganKind.Fruit,
  given: GIVEN_FRUIT,
};
