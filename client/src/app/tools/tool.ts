import type { StrokePoint } from "../gestures";

/** What takes the strokes of a finger, a pen or the left mouse button. */
export interface Tool {
  begin(point: StrokePoint): void;
  move(points: readonly StrokePoint[]): void;
  end(): void;
  /** Forgets the stroke: nothing more of it is sent. */
  abandon(): void;
  /** Called again and again while the stroke lasts. */
  tick?(): void;
  /** A mouse or pen is over the canvas and not down. */
  hover?(x: number, y: number): void;
}

/** How near to a branch a stroke must begin to begin on it, in pixels. */
export const PICK_TOLERANCE = 24;
/** Positions beyond this are refused (`LM2`). */
const REACH = 1000;

/** The nearest place the server accepts; nothing grows below the ground. */
export function withinReach([x, y, z]: readonly [number, number, number]): [number, number, number] {
  const clamp = (value: number, least: number) => tidy(Math.min(REACH, Math.max(least, value)));
  return [clamp(x, -REACH), clamp(y, 0), clamp(z, -REACH)];
}

/** A thousandth of an internode is far below what anyone can see, and the message is half as long. */
export function tidy(value: number): number {
  return Math.round(value * 1000) / 1000;
}
