import type { DrawnElsewhere, Pick } from "../camera/picking";
import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import { NONE } from "./limbs";
import { ROW_NUMBERS } from "./moving";
import { NODE, nodeOn } from "./pose";
import { JOINT } from "./rides";
import type { Riding } from "./riding";

/** Where a row is. */
export type PlaceOf = (table: TreeTable, row: number) => Vec3;

/** Where rows are as the wind moves them: what shaders do, but for the shiver of twigs. */
export function swayedPlace(stands: Float64Array, { rows, count }: Riding, drawn: DrawnElsewhere | null): PlaceOf {
  const node = new Float64Array(NODE);
  return (table, row) => {
    const rest = drawn?.placeOf(table, row) ?? placeOf(table, row);
    const joint = row < count ? rows[ROW_NUMBERS * row + JOINT]! : NONE;
    if (joint === NONE) return rest;
    const position = table.course.placed;
    nodeOn(stands, joint, position, 3 * row, rows, ROW_NUMBERS * row, node);
    const height = position[3 * row + 1]!;
    const y = Math.max(node[1]!, Math.min(height, 0));
    return [rest[0] + node[0]! - position[3 * row]!, rest[1] + y - height, rest[2] + node[2]! - position[3 * row + 2]!];
  };
}

/** Where a point that was picked on a swaying branch is at rest. */
export function restingPlace(table: TreeTable, pick: Pick, seen: PlaceOf, drawn: DrawnElsewhere | null): Vec3 {
  const { row, point } = pick;
  const parent = table.parent[row]!;
  const [a, b] = [seen(table, parent), seen(table, row)];
  const length = distance(a, b);
  const share = length > 0 ? Math.min(1, distance(a, point) / length) : 0;
  const rest = (of: number) => drawn?.placeOf(table, of) ?? placeOf(table, of);
  const [from, to] = [rest(parent), rest(row)];
  const at = (axis: 0 | 1 | 2) => from[axis] + (to[axis] - from[axis]) * share;
  return [at(0), at(1), at(2)];
}

function placeOf({ course: { placed } }: TreeTable, row: number): Vec3 {
  return [placed[3 * row]!, placed[3 * row + 1]!, placed[3 * row + 2]!];
}

function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
