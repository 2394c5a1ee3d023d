import { radiusOf, type TreeTable } from "./tree-table";

/** Where a tree stands: the row of its seed, and the radius of the thickest wood that grows from it, in internodes. */
export interface TrunkFoot {
  readonly seed: number;
  readonly radius: number;
}

/** The feet of trees that live, by the rows of their first wood; a seed from which nothing grows has none. */
export function trunkFeet({
  rows,
  parent,
  radiusCode,
}: Pick<TreeTable, "rows" | "parent" | "radiusCode">): TrunkFoot[] {
  const thickest = new Map<number, number>();
  for (let row = 0; row < rows; row += 1) {
    const seed = parent[row]!;
    if (seed < 0 || parent[seed]! >= 0) continue;
    const radius = radiusOf(radiusCode[row]!);
    if (radius > (thickest.get(seed) ?? 0)) thickest.set(seed, radius);
  }
  return Array.from(thickest, ([seed, radius]) => ({ seed, radius }));
}
