import type { TreeTable } from "../scene/table/tree-table";
import type { FrameKind } from "../wire/envelope";
import type { Frame } from "../wire/frame";
import type { ServerFrame } from "../wire/server-frame";
import type { BrushView, Point, RowStore } from "./ports";

/** A frame that is no change of the table. */
export type AsideServerFrame = Exclude<ServerFrame, { readonly kind: typeof FrameKind.MeshDelta }>;

/** The table of rows as the connection sees it. */
export function rowStore(table: TreeTable): RowStore<Frame> {
  return {
    held: () =>
      table.epoch !== 0 && table.rows > 0
        ? { epoch: table.epoch, generations: table.generations(), rows: table.rows }
        : undefined,
    apply: (frame) => table.apply(frame),
    clear: () => table.clear(),
  };
}

/** The base of the plant nearest to a pixel; the origin while there is none. */
export function nearestBase(table: TreeTable, view: BrushView, x: number, y: number): Point {
  let nearest: Point = [0, 0, 0];
  let least = Number.POSITIVE_INFINITY;
  for (let row = 0; row < table.rows; row += 1) {
    if (table.parent[row] !== -1) {
      continue;
    }
    const base = [0, 1, 2].map((axis) => table.position[3 * row + axis] ?? 0) as [number, number, number];
    const place = view.pointOnPlane(x, y, base);
    const distance = place ? Math.hypot(place[0] - base[0], place[1] - base[1], place[2] - base[2]) : least;
    if (distance < least) {
      least = distance;
      nearest = base;
    }
  }
  return nearest;
}

/** Where seeds lie that have not grown yet, at most `most`. */
export function seedsToGrow(table: TreeTable, most: number): Point[] {
  const seeds: Point[] = [];
  for (let row = 0; row < table.rows && seeds.length < most; row += 1) {
    if (table.parent[row] === -1 && (table.successor[row] ?? -1) < 0) {
      seeds.push([0, 1, 2].map((axis) => table.position[3 * row + axis] ?? 0) as [number, number, number]);
    }
  }
  return seeds;
}

/** How many pixels an internode is long at a point. */
export function scaleAt(view: Pick<BrushView, "pointOnPlane">, point: Point): number {
  const [a, b] = [view.pointOnPlane(0, 0, point), view.pointOnPlane(100, 0, point)];
  return a && b ? 100 / Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) : 0;
}
