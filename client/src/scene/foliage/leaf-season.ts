import { type Course, LEAF_NATURES, type LeafKind } from "../../wire/generated";

/** What a time of the year does to leaves, each number 0 to 1. */
export interface Season {
  /** How large they are. */
  readonly unfolded: number;
  /** How many of them there are. */
  readonly present: number;
  /** How young their green is. */
  readonly fresh: number;
  /** How far the colours of autumn have come. */
  readonly turned: number;
  /** How far they have died. */
  readonly withered: number;
}

/** 0 bud burst, 1 summer, 2 autumn, 3 winter. */
export function seasonOf(kind: LeafKind, season: number): Season {
  const { unfolded, present, fresh, turned, withered } = LEAF_NATURES[kind];
  return {
    unfolded: at(unfolded, season),
    present: at(present, season),
    fresh: at(fresh, season),
    turned: at(turned, season),
    withered: at(withered, season),
  };
}

/** What a course has come to. */
function at({ start, changes }: Course, season: number): number {
  return changes.reduce((sum, { from, to, by }) => {
    const t = Math.min(1, Math.max(0, (season - from) / (to - from)));
    return sum + by * t * t * (3 - 2 * t);
  }, start);
}
