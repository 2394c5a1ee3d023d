import type { Vec3 } from "../vector";
import type { Joints } from "./joints";
import { axesAlong, profile } from "./wind";
import type { Wood } from "./wood";

/** Cells of the grid across the wind, each way; and the most slabs along it. */
const CELLS = 64;
const SLABS = 256;
/** The narrowest cell, m: wakes are wider. */
const NARROWEST = 0.2;
/** A wake has filled to 1/e after so many heights of what made it. */
const RECOVERY = 10;

/**
 * The share of the open wind's speed that each row gets past the crowns in front of it. Rows are marched through slab by slab
 * along the wind. Drag area A in a cell of area C takes momentum, so that speed falls by exp(−A/2C).
 */
export function behindCrowns({ parent, middle, dragArea }: Wood, along: Vec3): Float64Array {
  const axes = axesAlong(along);
  const shares = new Float64Array(parent.length).fill(1);
  const rows: number[] = [];
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  const at = (row: number, axis: 0 | 1 | 2) => {
    const [x, y, z] = axes[axis];
    return x * middle[3 * row]! + y * middle[3 * row + 1]! + z * middle[3 * row + 2]!;
  };
  for (let row = 0; row < parent.length; row += 1) {
    if (dragArea[row]! <= 0) continue;
    rows.push(row);
    for (const axis of [0, 1, 2] as const) {
      const place = at(row, axis);
      least[axis] = Math.min(least[axis]!, place);
      most[axis] = Math.max(most[axis]!, place);
    }
  }
  if (rows.length === 0) return shares;
  const cell = Math.max(Math.max(most[1]! - least[1]!, most[2]! - least[2]!) / CELLS, NARROWEST);
  const slab = Math.max((most[0]! - least[0]!) / SLABS, NARROWEST);
  const index = (way: number, size: number, count: number) => Math.min(Math.floor(way / size), count - 1);
  const slabs = rows.map((row) => index(at(row, 0) - least[0]!, slab, SLABS));
  const cells = rows.map(
    (row) => index(at(row, 1) - least[1]!, cell, CELLS) * CELLS + index(at(row, 2) - least[2]!, cell, CELLS),
  );
  // By slab, and in a slab in birth order: so sums are the same everywhere.
  const begin = new Int32Array(SLABS + 1);
  for (const each of slabs) begin[each + 1]! += 1;
  for (let each = 0; each < SLABS; each += 1) begin[each + 1]! += begin[each]!;
  const ordered = new Int32Array(rows.length);
  const next = begin.slice();
  for (const [i, each] of slabs.entries()) {
    ordered[next[each]!] = i;
    next[each]! += 1;
  }
  const recovery = Math.exp(-slab / (RECOVERY * Math.max(most[2]! - least[2]!, NARROWEST)));
  const upwind = new Float64Array(CELLS * CELLS);
  let reached = 0;
  for (let each = 0; each < SLABS; each += 1) {
    const [from, to] = [begin[each]!, begin[each + 1]!];
    if (from === to) continue;
    for (; reached < each; reached += 1) {
      for (let i = 0; i < upwind.length; i += 1) upwind[i]! *= recovery;
    }
    for (let i = from; i < to; i += 1) {
      const of = ordered[i]!;
      shares[rows[of]!] = Math.exp((-0.5 * upwind[cells[of]!]!) / (cell * cell));
    }
    for (let i = from; i < to; i += 1) upwind[cells[ordered[i]!]!]! += dragArea[rows[ordered[i]!]!]!;
  }
  return shares;
}

/**
 * For each joint its wind as a share of the open wind's speed at 10 m: by height, and by what rows get behind what shelters them,
 * weighted by the drag area of what the joint bears.
 */
export function exposureOf({ count, first }: Joints, wood: Wood, shares: Float64Array): Float64Array {
  const area = wood.dragArea.slice();
  const pressed = new Float64Array(area.length);
  for (let row = 0; row < area.length; row += 1) {
    const speed = profile(wood.middle[3 * row + 1]!) * shares[row]!;
    pressed[row] = area[row]! * speed * speed;
  }
  for (let row = area.length - 1; row >= 0; row -= 1) {
    const node = wood.parent[row]!;
    if (node < 0) continue;
    area[node]! += area[row]!;
    pressed[node]! += pressed[row]!;
  }
  const exposure = new Float64Array(count);
  for (let joint = 0; joint < count; joint += 1) {
    exposure[joint] = Math.sqrt(pressed[first[joint]!]! / area[first[joint]!]!);
  }
  return exposure;
}
