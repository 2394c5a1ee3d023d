import type { TreeTable } from "../../scene/table/tree-table";
import type { Vec3 } from "../../scene/vector";
import type { BrushView } from "./brush-view";

/** The base of the plant nearest to a pixel; the origin while there is none. */
export function nearestBase(table: TreeTable, view: BrushView, x: number, y: number): Vec3 {
  let nearest: Vec3 = [0, 0, 0];
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

/** Where seeds lie that have not grown yet, and no plant stands, at most `most`. */
export function seedsToGrow(table: TreeTable, most: number): Vec3[] {
  const seeds = new Map<string, Vec3 | null>();
  for (let row = 0; row < table.rows; row += 1) {
    if (table.parent[row] === -1) {
      const place = [0, 1, 2].map((axis) => table.position[3 * row + axis] ?? 0) as [number, number, number];
      if (table.successor[row]! >= 0) seeds.set(`${place}`, null);
      else if (!seeds.has(`${place}`)) seeds.set(`${place}`, place);
    }
  }
  return [...seeds.values()].filter((place) => place !== null).slice(0, most);
}

/** How many pixels an internode is long at a point. */
export function scaleAt(view: Pick<BrushView, "pointOnPlane">, point: Vec3): number {
  const [a, b] = [view.pointOnPlane(0, 0, point), view.pointOnPlane(100, 0, point)];
  return a && b ? 100 / Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) : 0;
}
