import type { Vec3 } from "../vector";

/** Steps along each piece between two points, and of the table, as the server has them (`server/design/src/curve.rs`). */
const STEPS = 16;
const INTERVALS = 64;

/** The course of an axis from the origin to (0, 1, 0): a centripetal Catmull-Rom curve through a few points. */
export class AxisCurve {
  /** Places at equal steps along it. */
  readonly places: readonly Vec3[];
  /** Its length where its chord is 1. */
  readonly length: number;

  constructor(readonly points: readonly Vec3[]) {
    const fine = smooth(points);
    const spans = fine.slice(1).map((place, at) => distance(place, fine[at] ?? place));
    this.length = spans.reduce((sum, span) => sum + span, 0);
    const places: Vec3[] = [];
    let [piece, passed] = [0, 0];
    for (let at = 0; at < INTERVALS; at += 1) {
      const wanted = (this.length * at) / INTERVALS;
      while (passed + (spans[piece] ?? 0) < wanted && piece + 2 < fine.length) {
        passed += spans[piece] ?? 0;
        piece += 1;
      }
      const span = spans[piece] ?? 0;
      const share = span > 0 ? Math.min(Math.max((wanted - passed) / span, 0), 1) : 0;
      places.push(between(fine[piece] ?? [0, 0, 0], fine[piece + 1] ?? [0, 1, 0], share));
    }
    this.places = [...places, fine.at(-1) ?? [0, 1, 0]];
  }

  /** The place at a share t of its length, kept within 0 and 1. */
  at(t: number): Vec3 {
    const place = Math.min(Math.max(t, 0), 1) * INTERVALS;
    const interval = Math.min(Math.floor(place), INTERVALS - 1);
    return between(this.places[interval] ?? [0, 0, 0], this.places[interval + 1] ?? [0, 1, 0], place - interval);
  }
}

/** The curve in short straight pieces. */
function smooth(points: readonly Vec3[]): readonly Vec3[] {
  const last = points.length - 1;
  if (last === 1) {
    return points;
  }
  const known = (at: number) => points[at] ?? [0, 0, 0];
  const beyond = (end: Vec3, before: Vec3): Vec3 => [
    2 * end[0] - before[0],
    2 * end[1] - before[1],
    2 * end[2] - before[2],
  ];
  // Beyond its ends the curve goes on as it began.
  const point = (at: number): Vec3 => {
    if (at < 0) {
      return beyond(known(0), known(1));
    }
    return at > last ? beyond(known(last), known(last - 1)) : known(at);
  };
  const fine: Vec3[] = [known(0)];
  for (let piece = 0; piece < last; piece += 1) {
    const [p0, p1, p2, p3] = [point(piece - 1), point(piece), point(piece + 1), point(piece + 2)];
    const [a, b, c] = [knot(p0, p1), knot(p1, p2), knot(p2, p3)];
    for (let step = 1; step <= STEPS; step += 1) {
      const s = step / STEPS;
      const [s2, s3] = [s * s, s * s * s];
      const [from, outward, to, inward] = [2 * s3 - 3 * s2 + 1, s3 - 2 * s2 + s, 3 * s2 - 2 * s3, s3 - s2];
      fine.push(
        each((axis) => {
          const [q0, q1, q2, q3] = [p0[axis], p1[axis], p2[axis], p3[axis]];
          const out = (q1 - q0) / a - (q2 - q0) / (a + b) + (q2 - q1) / b;
          const into = (q2 - q1) / b - (q3 - q1) / (b + c) + (q3 - q2) / c;
          return q1 * from + out * b * outward + q2 * to + into * b * inward;
        }),
      );
    }
  }
  return fine;
}

function knot(from: Vec3, to: Vec3): number {
  return Math.max(Math.sqrt(distance(from, to)), 1e-4);
}

function each(of: (axis: 0 | 1 | 2) => number): Vec3 {
  return [of(0), of(1), of(2)];
}

function between(from: Vec3, to: Vec3, share: number): Vec3 {
  return each((axis) => from[axis] + (to[axis] - from[axis]) * share);
}

function distance(from: Vec3, to: Vec3): number {
  return Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
}
