import type { Vec3 } from "../../../scene/vector";

/** A rotation: x, y, z, w. */
export type Rotation = readonly [number, number, number, number];

export const UNTURNED: Rotation = [0, 0, 0, 1];

/** Vectors shorter than this, in internodes, have no direction. */
const SHORTEST = 1e-6;

/** The rotation by an angle in radians about an axis. */
export function about(axis: Vec3, angle: number): Rotation {
  const direction = normalised(axis);
  if (!direction) {
    return UNTURNED;
  }
  const s = Math.sin(angle / 2);
  return [direction[0] * s, direction[1] * s, direction[2] * s, Math.cos(angle / 2)];
}

/** The shortest rotation that turns one direction to another. */
export function between(from: Vec3, to: Vec3): Rotation {
  const [a, b] = [normalised(from), normalised(to)];
  if (!a || !b) {
    return UNTURNED;
  }
  const cosine = dot(a, b);
  if (cosine < -1 + 1e-9) {
    // Every axis across will do to turn right round.
    const across = Math.abs(a[0]) < 0.8 ? cross(a, [1, 0, 0]) : cross(a, [0, 0, 1]);
    return about(across, Math.PI);
  }
  const [x, y, z] = cross(a, b);
  return unit([x, y, z, 1 + cosine]);
}

/** First the second rotation, then the first. */
export function after([ax, ay, az, aw]: Rotation, [bx, by, bz, bw]: Rotation): Rotation {
  return unit([
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ]);
}

/** A vector turned. */
export function turned([x, y, z, w]: Rotation, vector: Vec3): Vec3 {
  const [ux, uy, uz] = cross([x, y, z], vector);
  const inner: Vec3 = [ux + w * vector[0], uy + w * vector[1], uz + w * vector[2]];
  const [vx, vy, vz] = cross([x, y, z], inner);
  return [vector[0] + 2 * vx, vector[1] + 2 * vy, vector[2] + 2 * vz];
}

/** How far a rotation turns, in radians. */
export function angleOf([x, y, z, w]: Rotation): number {
  return 2 * Math.atan2(Math.hypot(x, y, z), Math.abs(w));
}

/** The screen as directions in the world: to the right, up, and out towards the eye. */
export interface ScreenAxes {
  readonly right: Vec3;
  readonly up: Vec3;
}

/**
 * A ball around a branch's base that is turned by what the finger holds: the place that was gripped stays under the
 * finger, and rolls over the ball's edge where the finger leaves it. Where the finger comes back, so does the branch.
 */
export class Ball {
  #axes: ScreenAxes;
  #out: Vec3;
  #radius: number;
  #grip: Vec3;

  /** `grip` is the place held, as it lies from the ball's middle; a ball is never smaller than `least`. */
  constructor(grip: Vec3, least: number, axes: ScreenAxes) {
    this.#axes = axes;
    this.#out = cross(axes.right, axes.up);
    this.#radius = Math.max(length(grip), least, SHORTEST);
    this.#grip = grip;
    if (length(grip) < this.#radius) {
      // Held nearer to the middle than the ball is wide: what is held is the ball's face.
      this.#grip = this.#facing(dot(grip, axes.right), dot(grip, axes.up), 1);
    }
  }

  /** The rotation that brings what is held to a place so far right and up from the middle, in internodes. */
  to(right: number, up: number): Rotation {
    const side = dot(this.#grip, this.#out) < 0 ? -1 : 1;
    return between(this.#grip, this.#facing(right, up, side));
  }

  #facing(right: number, up: number, side: 1 | -1): Vec3 {
    const { right: x, up: y } = this.#axes;
    const away = Math.hypot(right, up);
    const shrink = away > this.#radius ? this.#radius / away : 1;
    const [a, b] = [right * shrink, up * shrink];
    const c = side * Math.sqrt(Math.max(0, this.#radius ** 2 - a * a - b * b));
    const out = this.#out;
    return [a * x[0] + b * y[0] + c * out[0], a * x[1] + b * y[1] + c * out[1], a * x[2] + b * y[2] + c * out[2]];
  }
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function length(a: Vec3): number {
  return Math.hypot(a[0], a[1], a[2]);
}

/** The same direction with length 1; null where there is none. */
export function normalised(a: Vec3): Vec3 | null {
  const long = length(a);
  return long < SHORTEST ? null : [a[0] / long, a[1] / long, a[2] / long];
}

function unit([x, y, z, w]: Rotation): Rotation {
  const long = Math.hypot(x, y, z, w) || 1;
  return [x / long, y / long, z / long, w / long];
}
