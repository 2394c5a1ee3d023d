/** A function of the place along an axis: places from 0 to 1, and its values there. */
export type Points = readonly (readonly [number, number])[];

/** So many points a function has at most (`server/design/src/function.rs`). */
export const MOST_POINTS = 16;

export function isPoints(value: unknown): value is Points {
  return Array.isArray(value) && value.every((point) => Array.isArray(point) && point.length === 2);
}

/** So finely functions are combined, before points are left out. */
const EVENLY = Array.from({ length: 49 }, (_, step) => step / 48);
/** Nobody sees a difference that is this share of the span of all values. */
const UNSEEN = 1e-4;

/**
 * The value of a function at a place along an axis, as the server has it (`server/design/src/function.rs`): a monotone
 * cubic after Fritsch and Butland, which goes beyond none of its points.
 */
export function valueAt(points: Points, t: number): number {
  return valuesOf(points, [t])[0] ?? 0;
}

/** Its values at places that rise. */
export function valuesOf(points: Points, places: readonly number[]): readonly number[] {
  const [only] = points;
  if (points.length < 2 || !only) {
    return places.map(() => only?.[1] ?? 0);
  }
  const slopes = slopesOf(points);
  return places.map((t) => {
    const after = points.findIndex(([place]) => place >= t);
    const at = Math.min(Math.max((after < 0 ? points.length : after) - 1, 0), points.length - 2);
    const [[t0, y0], [t1, y1]] = [pointAt(points, at), pointAt(points, at + 1)];
    const s = Math.min(Math.max((t - t0) / (t1 - t0), 0), 1);
    const [d0, d1] = [(slopes[at] ?? 0) * (t1 - t0), (slopes[at + 1] ?? 0) * (t1 - t0)];
    const value = y0 + s * (d0 + s * (3 * (y1 - y0) - 2 * d0 - d1 + s * (d0 + d1 - 2 * (y1 - y0))));
    return Math.min(Math.max(value, Math.min(y0, y1)), Math.max(y0, y1));
  });
}

/** Two functions combined place by place, by no more points than it takes to come within a share of the span of values. */
export function combinedCourse(
  a: Points,
  b: Points,
  join: (a: number, b: number) => number,
  tolerance = UNSEEN,
): Points {
  const own = [...a, ...b].map(([t]) => t);
  const places = [...new Set([...own, ...EVENLY])].sort((a, b) => a - b);
  const [first, second] = [valuesOf(a, places), valuesOf(b, places)];
  const wanted = places.map((_, at) => join(first[at] ?? 0, second[at] ?? 0));
  const span = Math.max(...wanted) - Math.min(...wanted);
  const kept = new Set([0, places.length - 1]);
  const points = () => places.flatMap((t, at) => (kept.has(at) ? [[t, wanted[at] ?? 0] as const] : []));
  // The place where it is farthest off becomes a point, again and again.
  while (kept.size < MOST_POINTS) {
    const off = valuesOf(points(), places).map((value, at) => Math.abs(value - (wanted[at] ?? 0)));
    const most = Math.max(...off);
    if (most <= tolerance * span + 1e-9) {
      break;
    }
    kept.add(off.indexOf(most));
  }
  return points();
}

function slopesOf(points: Points): readonly number[] {
  const last = points.length - 1;
  const width = (at: number) => pointAt(points, at + 1)[0] - pointAt(points, at)[0];
  const secant = (at: number) => (pointAt(points, at + 1)[1] - pointAt(points, at)[1]) / width(at);
  if (last === 1) {
    return [secant(0), secant(0)];
  }
  const inner = (at: number) => {
    const [before, after] = [secant(at - 1), secant(at)];
    if (before * after <= 0) {
      return 0;
    }
    const [first, second] = [2 * width(at) + width(at - 1), width(at) + 2 * width(at - 1)];
    return (first + second) / (first / before + second / after);
  };
  const end = (near: number, far: number) => {
    const [h0, h1, s0, s1] = [width(near), width(far), secant(near), secant(far)];
    const slope = ((2 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
    if (slope * s0 <= 0) {
      return 0;
    }
    return s0 * s1 <= 0 && Math.abs(slope) > 3 * Math.abs(s0) ? 3 * s0 : slope;
  };
  return points.map((_, at) => (at === 0 ? end(0, 1) : at === last ? end(last - 1, last - 2) : inner(at)));
}

function pointAt(points: Points, at: number): readonly [number, number] {
  return points[at] ?? [0, 0];
}
