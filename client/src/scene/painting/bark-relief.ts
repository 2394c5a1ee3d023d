import type { BarkKind } from "../../wire/generated";
import { BARK_PATTERNS, type BarkPoint } from "./bark-pattern";
import { MOST_SHADE, MOST_SLOPE } from "./measures";

/** Texels along each side of a bark's square. */
export const BARK_SIDE = 512;

/** How high the ridges are, as a share of the square's side. */
const DEPTHS: Record<BarkKind, number> = {
  smooth: 0.011,
  furrowed: 0.034,
  plated: 0.028,
  papery: 0.01,
  flaking: 0.011,
  banded: 0.014,
  stringy: 0.026,
};

/** A bark as the graphics card has it, four bytes a texel, line upon line from the square's foot. */
export interface BarkTexels {
  /** Shares of the three colours, the first by its shade / `MOST_SHADE`; height. */
  readonly colours: Uint8Array<ArrayBuffer>;
  /** Slopes around and along, −`MOST_SLOPE` to `MOST_SLOPE`; how much of the sky is seen; height. */
  readonly relief: Uint8Array<ArrayBuffer>;
}

/** Makes a bark; the same one everywhere. */
export function barkTexels(kind: BarkKind, side = BARK_SIDE): BarkTexels {
  const pattern = BARK_PATTERNS[kind]();
  const heights = new Float32Array(side * side);
  const colours = new Uint8Array(4 * side * side);
  const relief = new Uint8Array(4 * side * side);
  const point: BarkPoint = { height: 0, shade: 0, second: 0, third: 0 };
  for (let y = 0; y < side; y += 1) {
    for (let x = 0; x < side; x += 1) {
      pattern((x + 0.5) / side, (y + 0.5) / side, point);
      const at = y * side + x;
      heights[at] = clamped(point.height);
      const third = clamped(point.third);
      const second = Math.min(clamped(point.second), 1 - third);
      colours[4 * at] = byte(((1 - second - third) * point.shade) / MOST_SHADE);
      colours[4 * at + 1] = byte(second);
      colours[4 * at + 2] = byte(third);
      colours[4 * at + 3] = relief[4 * at + 3] = byte(point.height);
    }
  }
  const near = softened(heights, side, Math.max(1, side >> 7));
  const far = softened(near, side, Math.max(2, side >> 5));
  // Rises over two texels, as a slope per side of the square.
  const steepness = (DEPTHS[kind] * side) / 2;
  for (let y = 0; y < side; y += 1) {
    const line = y * side;
    const below = ((y + side - 1) % side) * side;
    const above = ((y + 1) % side) * side;
    for (let x = 0; x < side; x += 1) {
      const at = line + x;
      const around = heights[line + ((x + 1) % side)]! - heights[line + ((x + side - 1) % side)]!;
      const along = heights[above + x]! - heights[below + x]!;
      relief[4 * at] = slope(around * steepness);
      relief[4 * at + 1] = slope(along * steepness);
      const sunk = Math.max(0, near[at]! - heights[at]!) + 1.5 * Math.max(0, far[at]! - heights[at]!);
      relief[4 * at + 2] = byte(1 / (1 + 60 * DEPTHS[kind] * sunk));
    }
  }
  return { colours, relief };
}

/** The mean of each texel's neighbourhood, within `reach` texels across and along. */
function softened(heights: Float32Array, side: number, reach: number): Float32Array {
  const lines = new Float32Array(heights.length);
  const both = new Float32Array(heights.length);
  slide(heights, lines, side, reach, 1, side);
  slide(lines, both, side, reach, side, 1);
  return both;
}

/** One direction of it: a window slides along each line and comes in again where it goes out. */
function slide(from: Float32Array, to: Float32Array, side: number, reach: number, next: number, line: number): void {
  const share = 1 / (2 * reach + 1);
  for (let first = 0; first < side; first += 1) {
    const start = first * line;
    let sum = 0;
    for (let i = -reach; i <= reach; i += 1) sum += from[start + ((i + side) % side) * next]!;
    for (let i = 0; i < side; i += 1) {
      to[start + i * next] = sum * share;
      sum += from[start + ((i + reach + 1) % side) * next]! - from[start + ((i - reach + side) % side) * next]!;
    }
  }
}

function slope(value: number): number {
  return byte(0.5 + value / (2 * MOST_SLOPE));
}

function clamped(value: number): number {
  return Math.min(1, Math.max(0, value));
}

function byte(value: number): number {
  return Math.round(255 * clamped(value));
}
