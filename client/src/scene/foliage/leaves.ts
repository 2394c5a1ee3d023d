import { leafHash } from "../leaf-hash";
import type { TreeTable } from "../table/tree-table";

const GOLDEN_ANGLE = 2.39996323;

/**
 * The azimuth of leaf `k` of `count` on a row's metamer (LF2), 0 to 2π: single precision would lose it otherwise. A
 * salt gives other things than leaves places of their own.
 */
export function leafAzimuth(row: number, k: number, count: number, salt = 0): number {
  return (GOLDEN_ANGLE * row + (salt % 7) + (2 * Math.PI * k) / count) % (2 * Math.PI);
}

/** The random number of a leaf's size (LF2), 0 to 1, or of something else with a salt. */
export function leafRandom(row: number, k: number, salt = 0): number {
  return leafHash(16 * (row ^ salt) + k) / 2 ** 32;
}

/** Of sixteen numbers a row has for its leaves, the one that all leaves of its shoot share. */
export const SHOOT = 13;
/** Metamers of one shoot at most: what is looked at of a long one. */
const LONGEST = 24;

/** The row that begins what grew of an axis in the same step. */
export function shootOf(
  { parent, startsAxis, born }: Pick<TreeTable, "parent" | "startsAxis" | "born">,
  row: number,
): number {
  let first = row;
  for (let n = 0; n < LONGEST && startsAxis[first] === 0; n += 1) {
    const before = parent[first]!;
    if (before < 0 || born[before] !== born[row]) break;
    first = before;
  }
  return first;
}
