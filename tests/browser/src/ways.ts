import type { Box } from "./picture";

/** A place on the glass, in pixels of the page. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** The middle of a box. */
export function middle({ x, y, width, height }: Box): Point {
  return { x: x + width / 2, y: y + height / 2 };
}

/** Points on a straight way, ends included. */
export function way(from: Point, to: Point, count = 24): Point[] {
  return Array.from({ length: count }, (_, i) => {
    const t = i / (count - 1);
    return { x: from.x + (to.x - from.x) * t, y: from.y + (to.y - from.y) * t };
  });
}

/** Points on a closed way around a middle, the first not repeated. */
export function loop(middle: Point, radii: Point, count = 40): Point[] {
  return Array.from({ length: count }, (_, i) => {
    const turn = (2 * Math.PI * i) / count;
    return { x: middle.x + radii.x * Math.sin(turn), y: middle.y + radii.y * Math.cos(turn) };
  });
}
