import type { BrushView, Point } from "./ports";

/** Where a point of the world is on the canvas, and how many pixels an internode is long there. */
export interface ScreenPlace {
  readonly x: number;
  readonly y: number;
  readonly pixelsPerInternode: number;
}

/** Projects a point by the plane through it: two edges of the canvas, seen on that plane, are a basis of the screen. */
export function screenPlace(
  view: Pick<BrushView, "pointOnPlane">,
  point: Point,
  width: number,
  height: number,
): ScreenPlace | null {
  const corner = view.pointOnPlane(0, 0, point);
  const right = view.pointOnPlane(width, 0, point);
  const down = view.pointOnPlane(0, height, point);
  if (!corner || !right || !down) {
    return null;
  }
  const across = subtract(right, corner);
  const along = subtract(down, corner);
  const offset = subtract(point, corner);
  const length = Math.sqrt(dot(across, across));
  return {
    x: (width * dot(offset, across)) / dot(across, across),
    y: (height * dot(offset, along)) / dot(along, along),
    pixelsPerInternode: width / length,
  };
}

function subtract(a: Point, b: Point): Point {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function dot(a: Point, b: Point): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
