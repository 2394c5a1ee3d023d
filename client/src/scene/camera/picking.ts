import { radiusOf, type TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";

/** The row under a place on the screen. */
export interface Pick {
  row: number;
  /** Where on it, as it is at rest. */
  point: Vec3;
  /** Where that is seen, if the wind has moved it from there. */
  seen?: Vec3;
}

/** A column-major matrix from the world to clip space, and the picture it is for. */
export interface Projection {
  clipFromWorld: ArrayLike<number>;
  width: number;
  height: number;
  /** Pixels that one internode has at clip w = 1. */
  pixelsPerInternode: number;
}

/** Where rows are drawn that are not where the table has them. */
export interface DrawnElsewhere {
  placeOf(table: TreeTable, row: number): Vec3;
  hides(row: number): boolean;
}

const MIN_W = 1e-3;

/**
 * The nearest living metamer to a place on the screen. All those about as near as the nearest compete by depth, so
 * that of branches that cross, the one in front is met.
 */
export function pickBranch(
  table: TreeTable,
  view: Projection,
  x: number,
  y: number,
  tolerancePixels: number,
  drawn: DrawnElsewhere | null = null,
): Pick | null {
  const { rows } = table;
  const { placed } = table.course;
  if (scratch.length < 3 * rows) scratch = new Float32Array(3 * table.parent.length);
  const screen = scratch;
  const m = view.clipFromWorld;
  const [m0, m4, m8, m12] = [m[0]!, m[4]!, m[8]!, m[12]!];
  const [m1, m5, m9, m13] = [m[1]!, m[5]!, m[9]!, m[13]!];
  const [m3, m7, m11, m15] = [m[3]!, m[7]!, m[11]!, m[15]!];
  const halfWidth = view.width / 2;
  const halfHeight = view.height / 2;
  const candidates: { row: number; gap: number; depth: number; share: number }[] = [];
  let nearest = tolerancePixels;
  for (let row = 0, at = 0; row < rows; row += 1, at += 3) {
    // A parent's row is below its child's (FR5), so that one pass both projects and compares.
    let px = placed[at]!;
    let py = placed[at + 1]!;
    let pz = placed[at + 2]!;
    if (drawn) [px, py, pz] = drawn.placeOf(table, row);
    const wb = m3 * px + m7 * py + m11 * pz + m15;
    const per = 1 / wb;
    const bx = halfWidth + halfWidth * (m0 * px + m4 * py + m8 * pz + m12) * per;
    const by = halfHeight - halfHeight * (m1 * px + m5 * py + m9 * pz + m13) * per;
    screen[at] = bx;
    screen[at + 1] = by;
    screen[at + 2] = wb;
    const parent = table.parent[row]!;
    const code = table.radiusCode[row]!;
    if (code === 0 || parent < 0 || drawn?.hides(row)) continue;
    const wa = screen[3 * parent + 2]!;
    if (wa < MIN_W || wb < MIN_W) continue;
    const ax = screen[3 * parent]!;
    const ay = screen[3 * parent + 1]!;
    // Most metamers are far from the finger: a box tells before a square root has to. No limb is thicker than this.
    const reach = tolerancePixels + THICKEST * (view.pixelsPerInternode / Math.min(wa, wb));
    if ((ax < x - reach && bx < x - reach) || (ax > x + reach && bx > x + reach)) continue;
    if ((ay < y - reach && by < y - reach) || (ay > y + reach && by > y + reach)) continue;
    const dx = bx - ax;
    const dy = by - ay;
    const length2 = dx * dx + dy * dy;
    const t = length2 > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length2)) : 0;
    const w = wa + (wb - wa) * t;
    const radius = (radiusOf(code) * view.pixelsPerInternode) / w;
    const gap = Math.max(0, distance(ax + dx * t - x, ay + dy * t - y) - radius);
    if (gap > nearest + 0.25 * tolerancePixels || gap > tolerancePixels) continue;
    nearest = Math.min(nearest, gap);
    // A share of the screen's line is a smaller share of the metamer the further that end is away.
    candidates.push({ row, gap, depth: w, share: (t * wa) / (t * wa + (1 - t) * wb) });
  }
  let best: (typeof candidates)[number] | null = null;
  for (const candidate of candidates) {
    if (candidate.gap > nearest + 0.25 * tolerancePixels) continue;
    if (!best || candidate.depth < best.depth) best = candidate;
  }
  if (!best) return null;
  const { row, share } = best;
  const parent = table.parent[row]!;
  const place = (of: number) =>
    drawn?.placeOf(table, of) ?? [placed[3 * of]!, placed[3 * of + 1]!, placed[3 * of + 2]!];
  const [a, b] = [place(parent), place(row)];
  const at = (axis: 0 | 1 | 2) => a[axis]! + (b[axis]! - a[axis]!) * share;
  return { row, point: [at(0), at(1), at(2)] };
}

const THICKEST = 6;

/** x, y in pixels and clip w of every node; kept, since a finger that moves picks again and again. */
let scratch = new Float32Array(0);

function distance(dx: number, dy: number): number {
  return Math.sqrt(dx * dx + dy * dy);
}
