import { AxisCurve } from "../../../scene/structure/axis-curve";
import type { Vec3 } from "../../../scene/vector";
import { minus, size } from "./space";

/** The course of an axis: from the origin to (0, 1, 0). */
export type Curve = readonly Vec3[];

export const STRAIGHT: Curve = [
  [0, 0, 0],
  [0, 1, 0],
];
const MOST_POINTS = 24;
const FARTHEST = 4;
/** Two points that follow one another are at least so far apart. */
const APART = 0.01;

/** A place in one of the planes that the axis stands in. */
type InPlane = readonly [across: number, up: number];

/** A point elsewhere in a plane; its ends stay, and no two points come to lie upon one another. */
export function moved(curve: Curve, at: number, side: 0 | 2, to: InPlane): Curve {
  if (at <= 0 || at >= curve.length - 1) {
    return curve;
  }
  const old = curve[at] ?? [0, 0, 0];
  const [aside, up] = [tidy(to[0]), tidy(to[1])];
  const place: Vec3 = side === 0 ? [aside, up, old[2]] : [old[0], up, aside];
  const next = curve.map((point, index) => (index === at ? place : point));
  return isApart(next) ? next : curve;
}

/** A point more, between the two that it is nearest to. */
export function added(curve: Curve, side: 0 | 2, to: InPlane): { readonly value: Curve; readonly at: number } | null {
  if (curve.length >= MOST_POINTS) {
    return null;
  }
  const { places } = new AxisCurve(curve);
  const found = nearest(places, (place) => Math.hypot(place[side] - to[0], place[1] - to[1]));
  const on = places[found] ?? [0, 0.5, 0];
  // The points that lie before it along the course.
  const before = curve.filter((point) => nearest(places, (place) => size(minus(place, point))) < found).length;
  const at = Math.min(Math.max(before, 1), curve.length - 1);
  const [aside, up, deep] = [tidy(to[0]), tidy(to[1]), tidy(on[side === 0 ? 2 : 0])];
  const point: Vec3 = side === 0 ? [aside, up, deep] : [deep, up, aside];
  const value = [...curve.slice(0, at), point, ...curve.slice(at)];
  return isApart(value) ? { value, at } : null;
}

/** A point less; nothing where it is an end. */
export function without(curve: Curve, at: number): Curve | null {
  const next = curve.filter((_, index) => index !== at);
  return at > 0 && at < curve.length - 1 && isApart(next) ? next : null;
}

/** The same course on the other side. */
export function mirrored(curve: Curve, side: 0 | 2): Curve {
  return curve.map(([x, y, z]): Vec3 => (side === 0 ? [-x || 0, y, z] : [x, y, -z || 0]));
}

/** Whether all points that follow one another are far enough apart. */
export function isApart(curve: Curve): boolean {
  return curve.every((point, at) => at === 0 || size(minus(point, curve[at - 1] ?? point)) > APART);
}

function nearest(places: Curve, far: (place: Vec3) => number): number {
  const distances = places.map(far);
  return distances.indexOf(Math.min(...distances));
}

/** A coordinate in range, to a thousandth; no −0, which would be another value. */
export function tidy(part: number): number {
  return Math.round(Math.min(Math.max(part, -FARTHEST), FARTHEST) * 1000) / 1000 || 0;
}
