/** A point of an outline; in pixels while it is drawn, in internodes on its plane. */
export type Point2 = readonly [number, number];

/** Lines on which an outline's area is measured. */
const SCAN_LINES = 128;

/** The same line with fewer points: none of those left out lies further than `tolerance` from it (Douglas–Peucker). */
export function simplified(points: readonly Point2[], tolerance: number): Point2[] {
  const last = points.length - 1;
  if (last < 2) {
    return [...points];
  }
  const keep = new Uint8Array(points.length);
  keep[0] = 1;
  keep[last] = 1;
  const spans: [number, number][] = [[0, last]];
  for (let span = spans.pop(); span !== undefined; span = spans.pop()) {
    const [from, to] = span;
    let furthest = tolerance;
    let index = -1;
    for (let i = from + 1; i < to; i += 1) {
      const distance = distanceToSegment(points[i]!, points[from]!, points[to]!);
      if (distance > furthest) {
        furthest = distance;
        index = i;
      }
    }
    if (index !== -1) {
      keep[index] = 1;
      spans.push([from, index], [index, to]);
    }
  }
  return points.filter((_, i) => keep[i] === 1);
}

/** The same, with at most `limit` points: of a scribble that has more, only every so many are kept. */
export function simplifiedTo(points: readonly Point2[], tolerance: number, limit: number): Point2[] {
  const fewer = simplified(points, tolerance);
  const stride = Math.ceil(fewer.length / limit);
  return stride < 2 ? fewer : fewer.filter((_, i) => i % stride === 0);
}

/**
 * The area inside a closed outline by the even-odd rule, which is how it is filled: a figure of eight has both its
 * loops, and a line drawn to and fro has nothing.
 */
export function enclosedArea(outline: readonly Point2[]): number {
  const low = Math.min(...outline.map(([, y]) => y));
  const high = Math.max(...outline.map(([, y]) => y));
  const step = (high - low) / SCAN_LINES;
  if (outline.length < 3 || !(step > 0)) {
    return 0;
  }
  let area = 0;
  for (let line = 0; line < SCAN_LINES; line += 1) {
    const crossings = crossingsAt(outline, low + (line + 0.5) * step);
    for (let i = 0; i + 1 < crossings.length; i += 2) {
      area += (crossings[i + 1]! - crossings[i]!) * step;
    }
  }
  return area;
}

function crossingsAt(outline: readonly Point2[], y: number): number[] {
  const crossings: number[] = [];
  let [ax, ay] = outline[outline.length - 1]!;
  for (const [bx, by] of outline) {
    if (ay < y !== by < y) {
      crossings.push(ax + ((y - ay) / (by - ay)) * (bx - ax));
    }
    [ax, ay] = [bx, by];
  }
  return crossings.sort((a, b) => a - b);
}

function distanceToSegment([x, y]: Point2, [ax, ay]: Point2, [bx, by]: Point2): number {
  const [dx, dy] = [bx - ax, by - ay];
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length2)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}
