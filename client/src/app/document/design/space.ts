import type { Vec3 } from "../../../scene/vector";

/** A rotation: x, y, z, w. */
export type Turn = readonly [number, number, number, number];

export function plus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function times(a: Vec3, factor: number): Vec3 {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function across(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function size(a: Vec3): number {
  return Math.hypot(...a);
}

/** A vector of length 1 along another; up where that has none. */
export function unit(a: Vec3): Vec3 {
  const length = size(a);
  return length > 1e-9 ? times(a, 1 / length) : [0, 1, 0];
}

export function turned([x, y, z, w]: Turn, a: Vec3): Vec3 {
  const axis: Vec3 = [x, y, z];
  const twice = times(across(axis, a), 2);
  return plus(plus(a, times(twice, w)), across(axis, twice));
}

export function turnedBack([x, y, z, w]: Turn, a: Vec3): Vec3 {
  return turned([-x, -y, -z, w], a);
}

/** One turn after another. */
export function joined([ax, ay, az, aw]: Turn, [bx, by, bz, bw]: Turn): Turn {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

/** The turn by the shorter arc from one unit vector to another. */
export function turnBetween(from: Vec3, to: Vec3): Turn {
  const axis = across(from, to);
  const w = 1 + dot(from, to);
  if (w < 1e-6) {
    // Half a turn about anything that stands across.
    const side = unit(across(from, Math.abs(from[0]) < 0.9 ? [1, 0, 0] : [0, 0, 1]));
    return [...side, 0];
  }
  const length = Math.hypot(...axis, w);
  return [axis[0] / length, axis[1] / length, axis[2] / length, w / length];
}

/** The angle between two vectors, in degrees. */
export function angleBetween(a: Vec3, b: Vec3): number {
  return (Math.atan2(size(across(a, b)), dot(a, b)) * 180) / Math.PI;
}
