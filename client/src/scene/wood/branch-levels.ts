/** How metamers of one size on the screen are drawn. */
export interface Level {
  /** Radius in pixels from which it applies. */
  readonly from: number;
  /** Sides of the tube; 0 for a strip that faces the eye. */
  readonly sides: number;
  readonly segments: number;
  /** Sides and segments while frames must be quick. */
  readonly quick: readonly [sides: number, segments: number];
}

/** From the finest to the coarsest. The last two differ in how long a metamer may look. */
export const LEVELS: readonly Level[] = [
  { from: 60, sides: 56, segments: 10, quick: [16, 5] },
  { from: 18, sides: 16, segments: 6, quick: [9, 4] },
  { from: 6, sides: 10, segments: 4, quick: [6, 3] },
  { from: 2.4, sides: 6, segments: 3, quick: [4, 1] },
  { from: 0, sides: 0, segments: 3, quick: [0, 2] },
  { from: 0, sides: 0, segments: 1, quick: [0, 1] },
];

const CURVED_STRIP = LEVELS.length - 2;
const STRAIGHT_STRIP = LEVELS.length - 1;
/** A strip shorter than this, in pixels, needs no curve. */
const SHORT = 11;
/** A metamer keeps its level until it is so much larger or smaller than the level is for: none flickers between two. */
const SLACK = 1.15;
/** The radii between which a metamer keeps each level. */
const LEAST = Float64Array.from(LEVELS, ({ from }) => from / SLACK);
const MOST = Float64Array.from(LEVELS, (_, i) =>
  i === 0 ? Number.POSITIVE_INFINITY : LEVELS[Math.min(i, CURVED_STRIP) - 1]!.from * SLACK,
);

/** How large a metamer is seen, in pixels: its radius, and the length of an internode. Numbers in an array make no garbage. */
export type Seen = Float64Array;

/** The level for a metamer seen like this that was on level `before`, or −1. */
export function levelFor(seen: Seen, before: number): number {
  if (before >= 0 && fits(seen, before)) return before;
  const [radius, internode] = [seen[0]!, seen[1]!];
  let level = 0;
  while (level < CURVED_STRIP && radius < LEVELS[level]!.from) level += 1;
  return level === CURVED_STRIP && internode < SHORT ? STRAIGHT_STRIP : level;
}

function fits(seen: Seen, level: number): boolean {
  if (seen[0]! < LEAST[level]! || seen[0]! >= MOST[level]!) return false;
  if (level < CURVED_STRIP) return true;
  return level === CURVED_STRIP ? seen[1]! >= SHORT / SLACK : seen[1]! < SHORT * SLACK;
}
