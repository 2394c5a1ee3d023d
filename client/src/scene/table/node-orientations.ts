/**
 * The orientations of nodes along an axis: a quaternion per node that turns X, Y, Z to normal, tangent and binormal.
 *
 * Successive orientations follow each other by double reflection (Wang et al. 2008), so a tube swept through them does
 * not twist.
 */

/** What the orientations are computed from. */
export interface Skeleton {
  /** x y z per row: where it is drawn. */
  position: Float32Array;
  /** x y z per row: the direction of the tube there. */
  across: Float32Array;
  /** -1 for a seed. */
  parent: Int32Array;
  /** 1 where a row begins an axis. */
  startsAxis: Uint8Array;
}

type Vector = [number, number, number];

const MIN_LENGTH = 1e-6;
/** The numbers of an orientation together differ by less than this where it is the same. */
const UNMOVED = 1e-6;
/** A vector with less of itself than this across an axis, squared, says nothing about which way is across. */
const MIN_ACROSS = 1e-4;

// What is computed for one row after the other lies in the same few places: a large tree would leave a dozen vectors a row
// to be collected, while the page waits for its first picture.
const TANGENT: Vector = [0, 0, 0];
const NORMAL: Vector = [0, 0, 0];
const BEARER: Vector = [0, 0, 0];
const STEP: Vector = [0, 0, 0];

/** Writes the orientation of `row` into `orientations` (x y z w per row), unless it moved by less than `slack`; says whether it did. */
export function updateOrientation(
  skeleton: Skeleton,
  orientations: Float32Array,
  row: number,
  slack = UNMOVED,
): boolean {
  const { across } = skeleton;
  set(TANGENT, across[3 * row]!, across[3 * row + 1]!, across[3 * row + 2]!);
  toNormal(NORMAL, skeleton, orientations, row, TANGENT);
  return writeOrientation(orientations, row, NORMAL, TANGENT, slack);
}

/** The third column of an orientation: its tangent. */
export function tangentOf(orientations: Float32Array, row: number, out: Vector = [0, 0, 0]): Vector {
  const at = 4 * row;
  const [x, y, z, w] = [orientations[at]!, orientations[at + 1]!, orientations[at + 2]!, orientations[at + 3]!];
  out[0] = 2 * (x * y - w * z);
  out[1] = 1 - 2 * (x * x + z * z);
  out[2] = 2 * (y * z + w * x);
  return out;
}

/** The first column of an orientation: its normal. */
export function normalOf(orientations: Float32Array, row: number, out: Vector = [0, 0, 0]): Vector {
  const at = 4 * row;
  const [x, y, z, w] = [orientations[at]!, orientations[at + 1]!, orientations[at + 2]!, orientations[at + 3]!];
  out[0] = 1 - 2 * (y * y + z * z);
  out[1] = 2 * (x * y + w * z);
  out[2] = 2 * (x * z - w * y);
  return out;
}

/** A lateral takes its normal from the axis that bears it, so that its bark turns with what bears it. */
function toNormal(out: Vector, skeleton: Skeleton, orientations: Float32Array, row: number, tangent: Vector): void {
  const parent = skeleton.parent[row]!;
  if (parent < 0 || skeleton.parent[parent]! < 0) {
    toAnyNormal(out, tangent);
    return;
  }
  normalOf(orientations, parent, out);
  if (skeleton.startsAxis[row] === 0) {
    transport(out, skeleton.position, parent, row, tangentOf(orientations, parent, BEARER), tangent);
  }
  makePerpendicular(out, tangent);
}

/** Double reflection: first across the plane between the nodes, then across the one between the tangents. */
function transport(
  normal: Vector,
  position: Float32Array,
  from: number,
  to: number,
  fromTangent: Vector,
  toTangent: Vector,
): void {
  toDifference(STEP, position, from, to);
  const c1 = dot(STEP, STEP);
  if (c1 < MIN_LENGTH * MIN_LENGTH) return;
  takeAway(normal, STEP, (2 / c1) * dot(STEP, normal));
  takeAway(fromTangent, STEP, (2 / c1) * dot(STEP, fromTangent));
  const turn = STEP;
  set(turn, toTangent[0] - fromTangent[0], toTangent[1] - fromTangent[1], toTangent[2] - fromTangent[2]);
  const c2 = dot(turn, turn);
  if (c2 < MIN_LENGTH * MIN_LENGTH) return;
  takeAway(normal, turn, (2 / c2) * dot(turn, normal));
}

/** Makes a vector perpendicular to a unit `tangent`, of length 1. */
function makePerpendicular(vector: Vector, tangent: Vector): void {
  takeAway(vector, tangent, dot(vector, tangent));
  if (dot(vector, vector) < MIN_ACROSS) toAnyNormal(vector, tangent);
  else normalise(vector);
}

function toAnyNormal(out: Vector, tangent: Vector): void {
  if (Math.abs(tangent[0]) < 0.8) set(out, 1, 0, 0);
  else set(out, 0, 0, 1);
  takeAway(out, tangent, dot(out, tangent));
  normalise(out);
}

/** The quaternion of the rotation whose columns are normal, tangent and normal × tangent. */
function writeOrientation(orientations: Float32Array, row: number, n: Vector, t: Vector, slack: number): boolean {
  const bx = n[1] * t[2] - n[2] * t[1];
  const by = n[2] * t[0] - n[0] * t[2];
  const bz = n[0] * t[1] - n[1] * t[0];
  const trace = n[0] + t[1] + bz;
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    return write(orientations, row, (t[2] - by) / s, (bx - n[2]) / s, (n[1] - t[0]) / s, s / 4, slack);
  }
  if (n[0] > t[1] && n[0] > bz) {
    const s = 2 * Math.sqrt(1 + n[0] - t[1] - bz);
    return write(orientations, row, s / 4, (t[0] + n[1]) / s, (bx + n[2]) / s, (t[2] - by) / s, slack);
  }
  if (t[1] > bz) {
    const s = 2 * Math.sqrt(1 + t[1] - n[0] - bz);
    return write(orientations, row, (t[0] + n[1]) / s, s / 4, (by + t[2]) / s, (bx - n[2]) / s, slack);
  }
  const s = 2 * Math.sqrt(1 + bz - n[0] - t[1]);
  return write(orientations, row, (bx + n[2]) / s, (by + t[2]) / s, s / 4, (n[1] - t[0]) / s, slack);
}

/** One of the two quaternions of a rotation: w is not negative, so that three numbers are enough to store it. */
function write(
  orientations: Float32Array,
  row: number,
  x: number,
  y: number,
  z: number,
  w: number,
  slack: number,
): boolean {
  const sign = w < 0 ? -1 : 1;
  const at = 4 * row;
  const moved =
    Math.abs(orientations[at]! - sign * x) +
    Math.abs(orientations[at + 1]! - sign * y) +
    Math.abs(orientations[at + 2]! - sign * z) +
    Math.abs(orientations[at + 3]! - sign * w);
  if (moved < slack) return false;
  orientations[at] = sign * x;
  orientations[at + 1] = sign * y;
  orientations[at + 2] = sign * z;
  orientations[at + 3] = sign * w;
  return true;
}

function toDifference(out: Vector, position: Float32Array, from: number, to: number): void {
  out[0] = position[3 * to]! - position[3 * from]!;
  out[1] = position[3 * to + 1]! - position[3 * from + 1]!;
  out[2] = position[3 * to + 2]! - position[3 * from + 2]!;
}

function normalise(v: Vector): void {
  const length = Math.sqrt(dot(v, v));
  if (length >= MIN_LENGTH) set(v, v[0] / length, v[1] / length, v[2] / length);
}

/** Takes a multiple of one vector from another. */
function takeAway(v: Vector, other: Vector, factor: number): void {
  v[0] -= factor * other[0];
  v[1] -= factor * other[1];
  v[2] -= factor * other[2];
}

function set(out: Vector, x: number, y: number, z: number): void {
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
