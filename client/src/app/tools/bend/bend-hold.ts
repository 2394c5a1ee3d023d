import { axisStart, pathUp } from "../../../scene/table/branch-rows";

/** What is asked of the rows. */
export interface Limbs {
  readonly rows: number;
  readonly parent: ArrayLike<number>;
  readonly startsAxis: ArrayLike<number>;
  readonly radiusCode: ArrayLike<number>;
}

/** Where a branch is held: the path from the base to the farthest touch, and which of its rows are touched. */
export interface Hold {
  /** From the base, which stays where it is, upwards. */
  readonly path: readonly number[];
  /** In the order asked for, those that are not on one path with the farthest left out. */
  readonly touches: readonly number[];
}

/** Whether one of two rows is above the other on one path. */
export function related(limbs: Limbs, a: number, b: number): boolean {
  return pathUp(limbs, Math.min(a, b), Math.max(a, b)) !== null;
}

/** Holds a branch that stays put at `base` at rows above it; null if none is. The farthest row is where it ends. */
export function holdAt(limbs: Limbs, base: number, rows: readonly number[]): Hold | null {
  let path: number[] | null = null;
  for (const row of rows) {
    const up = row > base ? pathUp(limbs, base, row) : null;
    if (up && up.length > (path?.length ?? 1)) path = up;
  }
  if (!path) return null;
  const on = new Set(path.slice(1));
  return { path, touches: [...new Set(rows.filter((row) => on.has(row)))] };
}

/** What stays where it is when a branch is taken with one finger: the wood that bears it, or its own lowest. */
export function naturalBase(limbs: Limbs, row: number): number {
  const first = axisStart(limbs, row);
  const bearing = limbs.parent[first] ?? -1;
  return bearing >= 0 && (limbs.parent[bearing] ?? -1) >= 0 ? bearing : first;
}
