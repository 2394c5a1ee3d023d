import type { TreeTable } from "../table/tree-table";
import { leafAzimuth } from "./leaves";
import type { Standing } from "./row-instances";

/** What an organ is, by the two highest bits of its number (LF5). */
export const OrganKind = { Leaf: 0, Flower: 1, Fruit: 2 } as const;
export type OrganKind = (typeof OrganKind)[keyof typeof OrganKind];

/** The shortest length of an organ in internodes, and by what power of e each further code lengthens it. */
const SHORTEST = 0.02;
const LENGTH_STEP = 0.03;
const NO_ORGANS: readonly number[] = [];

/** The numbers of the organs of a kind that a row is given; none where it bears what grows on such wood. */
export function organsOf(table: Pick<TreeTable, "organs">, row: number, kind: OrganKind): readonly number[] {
  const organs = table.organs.get(row);
  return organs === undefined ? NO_ORGANS : [...organs].filter((organ) => organ >>> 30 === kind);
}

/** How far around its metamer an organ points, in radians. */
export function organAzimuth(organ: number): number {
  return ((organ & 255) / 256) * 2 * Math.PI;
}

/** How far it points away from its metamer, in 1/255 of half a turn, and 256 for each 1/64 of a turn that it is rolled. */
export function organStance(organ: number): number {
  return ((organ >>> 8) & 255) + 256 * ((organ >>> 24) & 63);
}

/** Its length in internodes; 0 for what the look says. */
export function organLength(organ: number): number {
  const code = (organ >>> 16) & 255;
  return code === 0 ? 0 : SHORTEST * Math.exp((code - 1) * LENGTH_STEP);
}

/** How the `k`-th of `count` things of a row stands: as an organ does that the row is given, or else by rule (LF2). */
export function standingOf(row: number, k: number, count: number, organ?: number, salt = 0): Standing {
  return organ === undefined
    ? { azimuth: leafAzimuth(row, k, count, salt), along: (k + 1) / count, stance: -1, length: 0 }
    : { azimuth: organAzimuth(organ), along: 1, stance: organStance(organ), length: organLength(organ) };
}
