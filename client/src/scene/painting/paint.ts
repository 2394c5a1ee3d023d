import type { BarkKind, FlowerKind, FruitKind, LeafKind } from "../../wire/generated";
import { BARK_SIDE, barkTexels } from "./bark-relief";
import { FLOWER_PICTURES } from "./flowers";
import { FRUIT_PICTURES } from "./fruits";
import type { Levels } from "./leaf-atlas";
import { leafLevels } from "./leaf-pictures";
import { TILE_SIDE } from "./measures";
import { ornamentLevels } from "./ornament-levels";

/** What there are pictures of, and the kinds of each. */
export interface Kinds {
  readonly bark: BarkKind;
  readonly leaf: LeafKind;
  readonly flower: Exclude<FlowerKind, "none">;
  readonly fruit: Exclude<FruitKind, "none">;
}
export type Sort = keyof Kinds;

/** An order for one picture. */
export type Order = {
  readonly [S in Sort]: { readonly sort: S; readonly kind: Kinds[S]; readonly coarse: boolean };
}[Sort];

/** Coarse pictures are so many times smaller along each side: little enough to be painted within a frame's time. */
const COARSER = { bark: 8, leaf: 8, flower: 4, fruit: 4 } as const satisfies Record<Sort, number>;

/** Paints what was ordered, one picture after the other; the same ones everywhere. */
export function paint(order: Order): Levels[] {
  const shrunk = order.coarse ? COARSER[order.sort] : 1;
  switch (order.sort) {
    case "bark": {
      const { colours, relief } = barkTexels(order.kind, BARK_SIDE / shrunk);
      // The graphics card makes the coarser levels.
      return [{ colour: [colours], relief: [relief] }];
    }
    case "leaf":
      return leafLevels(order.kind, TILE_SIDE / shrunk);
    case "flower":
      return [ornamentLevels(FLOWER_PICTURES[order.kind], TILE_SIDE / shrunk)];
    case "fruit":
      return [ornamentLevels(FRUIT_PICTURES[order.kind], TILE_SIDE / shrunk)];
  }
}
