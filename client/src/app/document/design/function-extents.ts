import type { Points } from "./function-course";
import { NEUTRAL, type Range, type Relation } from "./relative-values";

/** What stands at the foot and at the top of a drawing. */
export interface Extent {
  readonly bottom: number;
  readonly top: number;
}

/** Of what is said, and of what comes of it: the same where nothing is said relative to anything. */
export interface Extents {
  readonly own: Extent;
  readonly result: Extent;
}

export interface Drawn {
  readonly points: Points;
  /** How far they may go, and how far they usually do. */
  readonly range: Range;
  readonly usual: Range;
}

/** Room above what is drawn, as a multiple of it. */
const ROOM = 1.25;
const ROUND = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];

/** What is drawn of a function of its own: what it needs, with room, and what is usual at least. */
export function extentOf({ points, range, usual }: Drawn): Extent {
  const values = points.map(([, value]) => value);
  return {
    bottom: Math.min(usual.least, 0, Math.max(range.least, -above(-Math.min(...values)))),
    top: Math.min(range.most, Math.max(usual.most, above(Math.max(...values)))),
  };
}

/**
 * What is drawn of a relative one, and beside it of what comes of it. An offset stands about the middle and has the scale
 * of what it is added to, so that it can be read off; of factors 1 stands in the middle as long as there is room.
 */
export function relativeExtents(own: Drawn, result: Drawn, relation: Relation): Extents {
  const results = extentOf(result);
  if (relation === "factor") {
    return { own: extentOf({ ...own, usual: { least: 0, most: 2 * NEUTRAL.factor } }), result: results };
  }
  const farthest = Math.max(...own.points.map(([, value]) => Math.abs(value)));
  const most = Math.max(Math.abs(own.range.least), Math.abs(own.range.most));
  const half = Math.max(Math.min(above(farthest), most), (results.top - results.bottom) / 2);
  return { own: { bottom: -half, top: half }, result: { bottom: results.bottom, top: results.bottom + 2 * half } };
}

/** A round number with room above a value; 0 where it is not above nothing. */
function above(value: number): number {
  if (value <= 0) {
    return 0;
  }
  const needed = ROOM * value;
  const unit = 10 ** Math.floor(Math.log10(needed));
  return unit * (ROUND.find((step) => step * unit >= needed - 1e-9) ?? 10);
}
