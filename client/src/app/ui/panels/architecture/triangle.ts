import type { Parameters } from "../../../../wire/generated";
import type { Place } from "./place";

/** The weights of direction (Figure 11): α of the heading, β of tropism, γ of free space. Their sum is 1. */
export type Weights = Pick<Parameters, "heading_weight" | "tropism_weight" | "space_weight">;

/** The corners H, T and E. */
export type Corners = readonly [Place, Place, Place];

/** The point that weights mean: the corners' mean with those weights. */
export function pointOf(weights: Weights, [h, t, e]: Corners): Place {
  const { heading_weight: alpha, tropism_weight: beta, space_weight: gamma } = weights;
  return { x: alpha * h.x + beta * t.x + gamma * e.x, y: alpha * h.y + beta * t.y + gamma * e.y };
}

/** The weights that a point means; one beside the triangle means the nearest point in it. */
export function weightsAt(point: Place, corners: Corners): Weights {
  const [h, t, e] = corners;
  const [alpha, beta] = barycentric(nearestWithin(point, corners), h, t, e);
  // Thousandths; what rounding leaves is the last one's, so that they are 1 together.
  const first = Math.min(1000, Math.max(0, Math.round(1000 * alpha)));
  const second = Math.min(1000 - first, Math.max(0, Math.round(1000 * beta)));
  return { heading_weight: first / 1000, tropism_weight: second / 1000, space_weight: (1000 - first - second) / 1000 };
}

function barycentric(point: Place, h: Place, t: Place, e: Place): readonly [number, number] {
  const area = cross(h, t, e);
  return [cross(point, t, e) / area, cross(h, point, e) / area];
}

function nearestWithin(point: Place, corners: Corners): Place {
  const [h, t, e] = corners;
  const [alpha, beta] = barycentric(point, h, t, e);
  if (alpha >= 0 && beta >= 0 && alpha + beta <= 1) {
    return point;
  }
  const sides = [nearestOn(point, h, t), nearestOn(point, t, e), nearestOn(point, e, h)];
  const distance = (to: Place) => Math.hypot(to.x - point.x, to.y - point.y);
  return sides.reduce((best, next) => (distance(next) < distance(best) ? next : best));
}

function nearestOn(point: Place, from: Place, to: Place): Place {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const along = ((point.x - from.x) * dx + (point.y - from.y) * dy) / (dx * dx + dy * dy);
  const share = Math.min(1, Math.max(0, along));
  return { x: from.x + share * dx, y: from.y + share * dy };
}

/** Twice the area of a triangle, with its sign. */
function cross(a: Place, b: Place, c: Place): number {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}
