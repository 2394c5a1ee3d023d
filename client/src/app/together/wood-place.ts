import type { Vec3 } from "../../scene/vector";

/** A place beside a metamer, which rides with it (PS1). */
export interface WoodPlace {
  readonly along: number;
  /** Along h, u and w of LF1. */
  readonly offset: Vec3;
}

/** Where a point lies beside the metamer from `a` to `b`. */
export function besideWood(point: Vec3, a: Vec3, b: Vec3): WoodPlace {
  const [way, rest] = [minus(b, a), minus(point, a)];
  const length = dot(way, way);
  const along = length > 0 ? Math.min(Math.max(dot(rest, way) / length, 0), 1) : 0;
  const aside = minus(rest, scaled(way, along));
  const axes = axesOf(way);
  return { along, offset: [dot(aside, axes[0]), dot(aside, axes[1]), dot(aside, axes[2])] };
}

/** The point that lies there, wherever the metamer is now. */
export function onWood({ along, offset }: WoodPlace, a: Vec3, b: Vec3): Vec3 {
  const way = minus(b, a);
  const [h, u, w] = axesOf(way);
  const at = (axis: 0 | 1 | 2) =>
    a[axis] + along * way[axis] + offset[0] * h[axis] + offset[1] * u[axis] + offset[2] * w[axis];
  return [at(0), at(1), at(2)];
}

/** Heading and two directions across it (LF1). */
function axesOf(way: Vec3): readonly [Vec3, Vec3, Vec3] {
  const length = Math.hypot(...way);
  const h: Vec3 = length > 0 ? scaled(way, 1 / length) : [0, 1, 0];
  const aside = cross(h, Math.abs(h[1]) > 0.99 ? [1, 0, 0] : [0, 1, 0]);
  const u = scaled(aside, 1 / Math.hypot(...aside));
  return [h, u, cross(h, u)];
}

function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function scaled(a: Vec3, by: number): Vec3 {
  return [a[0] * by, a[1] * by, a[2] * by];
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
