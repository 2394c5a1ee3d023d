/**
 * Frames of reference along an axis: a quaternion per node that turns X, Y, Z to normal, tangent and binormal.
 *
 * Successive frames follow each other by double reflection (Wang et al. 2008), so a tube swept through them does
 * not twist.
 */

/** What the frames are computed from. */
export interface Skeleton {
  /** x y z per row. */
  position: Float32Array;
  /** -1 for a seed. */
  parent: Int32Array;
  /** The row that continues the same axis, or -1. */
  successor: Int32Array;
  /** 1 where a row begins an axis. */
  startsAxis: Uint8Array;
}

type Vector = [number, number, number];

const MIN_LENGTH = 1e-6;
/** A vector with less of itself than this across an axis, squared, says nothing about which way is across. */
const MIN_ACROSS = 1e-4;

/** Writes the frame of `row` into `frames` (x y z w per row); says whether it moved noticeably. */
export function updateFrame(skeleton: Skeleton, frames: Float32Array, row: number): boolean {
  const tangent = nodeTangent(skeleton, row);
  const parent = skeleton.parent[row]!;
  return writeFrame(frames, row, normalAt(skeleton, frames, row, parent, tangent), tangent);
}

/** A lateral takes its normal from the axis that bears it, so that its bark turns with what bears it. */
function normalAt(skeleton: Skeleton, frames: Float32Array, row: number, parent: number, tangent: Vector): Vector {
  if (parent < 0 || skeleton.parent[parent]! < 0) return anyNormal(tangent);
  const normal = normalOf(frames, parent);
  if (skeleton.startsAxis[row] === 1) return perpendicular(normal, tangent);
  return transported(skeleton.position, parent, row, normal, tangentOf(frames, parent), tangent);
}

/** The direction of the tube at a node: the mean of the metamer that ends there and the one that goes on. */
export function nodeTangent(skeleton: Skeleton, row: number): Vector {
  const { position, parent, successor } = skeleton;
  const before = parent[row]!;
  const after = successor[row]!;
  const incoming = before >= 0 ? direction(position, before, row) : null;
  const outgoing = after >= 0 ? direction(position, row, after) : null;
  if (incoming && outgoing) {
    const mean = normalised(add(incoming, outgoing));
    // An axis that doubles back on itself has no mean direction; it keeps the incoming one.
    return mean ?? incoming;
  }
  return incoming ?? outgoing ?? [0, 1, 0];
}

/** The third column of a frame: its tangent. */
export function tangentOf(frames: Float32Array, row: number): Vector {
  const [x, y, z, w] = quaternion(frames, row);
  return [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)];
}

/** The first column of a frame: its normal. */
export function normalOf(frames: Float32Array, row: number): Vector {
  const [x, y, z, w] = quaternion(frames, row);
  return [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)];
}

function quaternion(frames: Float32Array, row: number): [number, number, number, number] {
  const at = 4 * row;
  return [frames[at]!, frames[at + 1]!, frames[at + 2]!, frames[at + 3]!];
}

/** Double reflection: first across the plane between the nodes, then across the one between the tangents. */
function transported(
  position: Float32Array,
  from: number,
  to: number,
  normal: Vector,
  fromTangent: Vector,
  toTangent: Vector,
): Vector {
  const step = difference(position, from, to);
  const c1 = dot(step, step);
  if (c1 < MIN_LENGTH * MIN_LENGTH) return perpendicular(normal, toTangent);
  const reflectedNormal = subtract(normal, scale(step, (2 / c1) * dot(step, normal)));
  const reflectedTangent = subtract(fromTangent, scale(step, (2 / c1) * dot(step, fromTangent)));
  const turn = subtract(toTangent, reflectedTangent);
  const c2 = dot(turn, turn);
  if (c2 < MIN_LENGTH * MIN_LENGTH) return perpendicular(reflectedNormal, toTangent);
  return perpendicular(subtract(reflectedNormal, scale(turn, (2 / c2) * dot(turn, reflectedNormal))), toTangent);
}

/** `vector` made perpendicular to a unit `tangent`. */
function perpendicular(vector: Vector, tangent: Vector): Vector {
  const across = subtract(vector, scale(tangent, dot(vector, tangent)));
  return dot(across, across) < MIN_ACROSS ? anyNormal(tangent) : (normalised(across) ?? anyNormal(tangent));
}

function anyNormal(tangent: Vector): Vector {
  const helper: Vector = Math.abs(tangent[0]) < 0.8 ? [1, 0, 0] : [0, 0, 1];
  return normalised(subtract(helper, scale(tangent, dot(helper, tangent)))) ?? [1, 0, 0];
}

/** The quaternion of the rotation whose columns are normal, tangent and normal × tangent. */
function writeFrame(frames: Float32Array, row: number, n: Vector, t: Vector): boolean {
  const b = cross(n, t);
  const trace = n[0] + t[1] + b[2];
  let [x, y, z, w] = [0, 0, 0, 1];
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    [x, y, z, w] = [(t[2] - b[1]) / s, (b[0] - n[2]) / s, (n[1] - t[0]) / s, s / 4];
  } else if (n[0] > t[1] && n[0] > b[2]) {
    const s = 2 * Math.sqrt(1 + n[0] - t[1] - b[2]);
    [x, y, z, w] = [s / 4, (t[0] + n[1]) / s, (b[0] + n[2]) / s, (t[2] - b[1]) / s];
  } else if (t[1] > b[2]) {
    const s = 2 * Math.sqrt(1 + t[1] - n[0] - b[2]);
    [x, y, z, w] = [(t[0] + n[1]) / s, s / 4, (b[1] + t[2]) / s, (b[0] - n[2]) / s];
  } else {
    const s = 2 * Math.sqrt(1 + b[2] - n[0] - t[1]);
    [x, y, z, w] = [(b[0] + n[2]) / s, (b[1] + t[2]) / s, s / 4, (n[1] - t[0]) / s];
  }
  // One of the two quaternions of a rotation: w is not negative, so that three numbers are enough to store it.
  const sign = w < 0 ? -1 : 1;
  const at = 4 * row;
  const moved =
    Math.abs(frames[at]! - sign * x) +
    Math.abs(frames[at + 1]! - sign * y) +
    Math.abs(frames[at + 2]! - sign * z) +
    Math.abs(frames[at + 3]! - sign * w);
  frames[at] = sign * x;
  frames[at + 1] = sign * y;
  frames[at + 2] = sign * z;
  frames[at + 3] = sign * w;
  return !(moved < 1e-6);
}

function difference(position: Float32Array, from: number, to: number): Vector {
  return [
    position[3 * to]! - position[3 * from]!,
    position[3 * to + 1]! - position[3 * from + 1]!,
    position[3 * to + 2]! - position[3 * from + 2]!,
  ];
}

function direction(position: Float32Array, from: number, to: number): Vector | null {
  return normalised(difference(position, from, to));
}

function normalised(v: Vector): Vector | null {
  const length = Math.hypot(v[0], v[1], v[2]);
  return length < MIN_LENGTH ? null : scale(v, 1 / length);
}

function add(a: Vector, b: Vector): Vector {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

function subtract(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function scale(a: Vector, factor: number): Vector {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
