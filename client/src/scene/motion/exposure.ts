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
export const RECOVERY = 10;

/**
 * The share of the open wind's speed that each row gets past the crowns in front of it. Rows are marched through slab by slab
 * along the wind. Drag area A in a cell of area C takes momentum, so that speed falls by exp(−A/2C).
 */
export function behindCrowns({ parent, middle, dragArea }: Wood, along: Vec3): Float64Array {
  const axes = axesAlong(along);
  const shares = new Float64Array(parent.length).fill(1);
  // Of the rows that take something of the wind: which they are, and where along, across and upward of it.
  const rows = new Int32Array(parent.length);
  const places = axes.map(() => new Float64Array(parent.length)) as [Float64Array, Float64Array, Float64Array];
  const [first, second, third] = places;
  const [a, b, c] = axes as readonly [Vec3, Vec3, Vec3];
  let count = 0;
  for (let row = 0; row < parent.length; row += 1) {
    if (dragArea[row]! <= 0) continue;
    const x = middle[3 * row]!;
    const y = middle[3 * row + 1]!;
    const z = middle[3 * row + 2]!;
    first[count] = a[0] * x + a[1] * y + a[2] * z;
    second[count] = b[0] * x + b[1] * y + b[2] * z;
    third[count] = c[0] * x + c[1] * y + c[2] * z;
    rows[count] = row;
    count += 1;
  }
  if (count === 0) return shares;
  const [alongIt, across, upward] = places.map((each) => rangeOf(each.subarray(0, count))) as [Range, Range, Range];
  const cell = Math.max(Math.max(across.extent, upward.extent) / CELLS, NARROWEST);
  const slab = Math.max(alongIt.extent / SLABS, NARROWEST);
  const index = (way: number, size: number, most: number) => Math.min(Math.floor(way / size), most - 1);
  const slabs = new Uint16Array(count);
  const cells = new Uint16Array(count);
  // By slab, and in a slab in birth order: so sums are the same everywhere.
  const begin = new Int32Array(SLABS + 1);
  for (let i = 0; i < count; i += 1) {
    slabs[i] = index(places[0]![i]! - alongIt.least, slab, SLABS);
    const column = index(places[1]![i]! - across.least, cell, CELLS);
    cells[i] = column * CELLS + index(places[2]![i]! - upward.least, cell, CELLS);
    begin[slabs[i]! + 1]! += 1;
  }
  for (let each = 0; each < SLABS; each += 1) begin[each + 1]! += begin[each]!;
  const ordered = new Int32Array(count);
  const next = begin.slice();
  for (let i = 0; i < count; i += 1) {
    ordered[next[slabs[i]!]!] = i;
    next[slabs[i]!]! += 1;
  }
  const recovery = Math.exp(-slab / (RECOVERY * Math.max(upward.extent, NARROWEST)));
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

interface Range {
  readonly least: number;
  readonly extent: number;
}

function rangeOf(numbers: Float64Array): Range {
  let [least, most] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const number of numbers) {
    least = Math.min(least, number);
    most = Math.max(most, number);
  }
  return { least, extent: most - least };
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
