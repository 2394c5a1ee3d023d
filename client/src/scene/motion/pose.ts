import type { Joints } from "./joints";
import { NONE } from "./limbs";
import { FIRST, JOINT, RIDE, SECOND, WEIGHT } from "./rides";
import type { Wood } from "./wood";

/** The furthest that a joint is turned back to keep what it bears above the ground, radians. */
const LIFT = 0.5;

/** Numbers of a stand: its own rotation; how the node it stands on has turned, x y z w; where the origin has gone with that. */
export const STAND = 10;
const [BEND, TURN, SHIFT] = [0, 3, 7];
/** Numbers of a node: where it is, and how it has turned, x y z w. */
export const NODE = 7;

/** What a pose needs of the rows that joints stand on and that hang lowest: place and ride, joint by joint. */
export interface Hinges {
  readonly count: number;
  readonly parent: Int32Array;
  /** Place and ride of the row at whose node each turns, and of the lowest that rides on it. */
  readonly numbers: Float64Array;
}

const HINGE = 2 * (3 + RIDE);
const LOWEST = 3 + RIDE;

/** Of joints as they were made. */
export function hingesOf({ count, parent, node, lowest, rides }: Joints, { place }: Wood): Hinges {
  const numbers = new Float64Array(HINGE * count);
  const copy = (row: number, to: number) => {
    numbers.set(place.subarray(3 * row, 3 * row + 3), to);
    numbers.set(rides.subarray(RIDE * row, RIDE * row + RIDE), to + 3);
  };
  for (let joint = 0; joint < count; joint += 1) {
    copy(node[joint]!, HINGE * joint);
    copy(lowest[joint]!, HINGE * joint + LOWEST);
  }
  return { count, parent, numbers };
}

/** Writes how all joints stand when they are turned. What was above the ground is held there as far as its own joint can. */
export function pose({ count, parent, numbers }: Hinges, bends: Float64Array, stands: Float64Array): void {
  for (let joint = 0; joint < count; joint += 1) {
    const [at, root] = [STAND * joint, HINGE * joint];
    for (let a = 0; a < 3; a += 1) {
      stands[at + BEND + a] = bends[3 * joint + a]!;
      stands[at + TURN + a] = 0;
      stands[at + SHIFT + a] = 0;
    }
    stands[at + TURN + 3] = 1;
    const carrier = parent[joint]!;
    if (carrier === NONE) continue;
    nodeOn(stands, carrier, numbers, root, numbers, root + 3, SCRATCH);
    for (let q = 0; q < 4; q += 1) stands[at + TURN + q] = SCRATCH[3 + q]!;
    turnBy(stands, at + TURN, numbers[root]!, numbers[root + 1]!, numbers[root + 2]!, TURNED);
    for (let a = 0; a < 3; a += 1) stands[at + SHIFT + a] = SCRATCH[a]! - TURNED[a]!;
    holdUp(stands, joint, numbers, root + LOWEST);
  }
}

/** Writes how a row's node stands. What its joint cannot hold up lies on the ground, or as deep as it was at rest. */
export function nodeAt(
  stands: Float64Array,
  rides: ArrayLike<number>,
  place: ArrayLike<number>,
  row: number,
  out: Float64Array,
): void {
  const joint = rides[RIDE * row + JOINT]!;
  if (joint === NONE) {
    for (let a = 0; a < NODE; a += 1) out[a] = a < 3 ? place[3 * row + a]! : a === NODE - 1 ? 1 : 0;
    return;
  }
  nodeOn(stands, joint, place, 3 * row, rides, RIDE * row, out);
  out[1] = Math.max(out[1]!, Math.min(place[3 * row + 1]!, 0));
}

const SCRATCH = new Float64Array(NODE);
const TURNED = new Float64Array(3);
const MOVED = new Float64Array(3);

/** Writes how a node stands that rides on a joint; its place and its ride begin at these numbers. */
export function nodeOn(
  stands: Float64Array,
  joint: number,
  place: ArrayLike<number>,
  at: number,
  rides: ArrayLike<number>,
  ride: number,
  out: Float64Array,
): void {
  const from = STAND * joint;
  const bx = stands[from]!;
  const by = stands[from + 1]!;
  const bz = stands[from + 2]!;
  shiftBy(rides, ride, bx, by, bz, MOVED);
  turnBy(stands, from + TURN, place[at]! + MOVED[0]!, place[at + 1]! + MOVED[1]!, place[at + 2]! + MOVED[2]!, out);
  for (let a = 0; a < 3; a += 1) out[a]! += stands[from + SHIFT + a]!;
  // The turn of the joint's node after the node's own share of the bend.
  const w = rides[ride + WEIGHT]!;
  const angle = w * Math.sqrt(bx * bx + by * by + bz * bz);
  const half = Math.abs(angle) < 1e-12 ? 0.5 * w : (w * Math.sin(0.5 * angle)) / angle;
  const [x, y, z, c] = [half * bx, half * by, half * bz, Math.cos(0.5 * angle)];
  const [qx, qy, qz, qw] = [stands[from + 3]!, stands[from + 4]!, stands[from + 5]!, stands[from + 6]!];
  out[3] = qw * x + qx * c + qy * z - qz * y;
  out[4] = qw * y - qx * z + qy * c + qz * x;
  out[5] = qw * z + qx * y - qy * x + qz * c;
  out[6] = qw * c - qx * x - qy * y - qz * z;
}

/** How far a row's node moves when its joint turns. */
function shiftBy(rides: ArrayLike<number>, ride: number, x: number, y: number, z: number, out: Float64Array): void {
  const squared = x * x + y * y + z * z;
  // Below, the factors are 1 and ½ to the last bit.
  const angle = Math.sqrt(squared);
  const across = squared < 1e-16 ? 1 : Math.sin(angle) / angle;
  const back = squared < 1e-16 ? 0.5 : (1 - Math.cos(angle)) / squared;
  const [fx, fy, fz] = [rides[ride + FIRST]!, rides[ride + FIRST + 1]!, rides[ride + FIRST + 2]!];
  const [sx, sy, sz] = [rides[ride + SECOND]!, rides[ride + SECOND + 1]!, rides[ride + SECOND + 2]!];
  const [cx, cy, cz] = [y * sz - z * sy, z * sx - x * sz, x * sy - y * sx];
  out[0] = across * (y * fz - z * fy) + back * (y * cz - z * cy);
  out[1] = across * (z * fx - x * fz) + back * (z * cx - x * cz);
  out[2] = across * (x * fy - y * fx) + back * (x * cy - y * cx);
}

/** A vector turned by a quaternion. */
function turnBy(q: Float64Array, at: number, a: number, b: number, c: number, out: Float64Array): void {
  const [x, y, z, w] = [q[at]!, q[at + 1]!, q[at + 2]!, q[at + 3]!];
  const ux = y * c - z * b + w * a;
  const uy = z * a - x * c + w * b;
  const uz = x * b - y * a + w * c;
  out[0] = a + 2 * (y * uz - z * uy);
  out[1] = b + 2 * (z * ux - x * uz);
  out[2] = c + 2 * (x * uy - y * ux);
}

/** Bends a joint less, so that its lowest row stays above the ground if it was there at rest. */
function holdUp(stands: Float64Array, joint: number, numbers: Float64Array, lowest: number): void {
  const at = STAND * joint;
  const rest = numbers[lowest + 1]!;
  const ride = lowest + 3;
  const [bx, by, bz] = [stands[at]!, stands[at + 1]!, stands[at + 2]!];
  for (let round = 0; round < 2; round += 1) {
    nodeOn(stands, joint, numbers, lowest, numbers, ride, SCRATCH);
    const sunk = Math.min(rest, 0) - SCRATCH[1]!;
    if (sunk <= 0) break;
    // How the node rises with the bend: (b × f)·u = b·(f × u), u being up as the joint's node sees it.
    const [x, y, z, w] = [stands[at + 3]!, stands[at + 4]!, stands[at + 5]!, stands[at + 6]!];
    const [ux, uy, uz] = [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)];
    const [fx, fy, fz] = [numbers[ride + FIRST]!, numbers[ride + FIRST + 1]!, numbers[ride + FIRST + 2]!];
    const [rx, ry, rz] = [fy * uz - fz * uy, fz * ux - fx * uz, fx * uy - fy * ux];
    const size = rx * rx + ry * ry + rz * rz;
    if (size < 1e-12) break;
    stands[at]! += rx * (sunk / size);
    stands[at + 1]! += ry * (sunk / size);
    stands[at + 2]! += rz * (sunk / size);
  }
  const [dx, dy, dz] = [stands[at]! - bx, stands[at + 1]! - by, stands[at + 2]! - bz];
  const far = Math.sqrt(dx * dx + dy * dy + dz * dz);
  if (far <= LIFT) return;
  stands[at] = bx + dx * (LIFT / far);
  stands[at + 1] = by + dy * (LIFT / far);
  stands[at + 2] = bz + dz * (LIFT / far);
}
