import type { GrammarReport } from "../../../wire/generated";

/** Depths that a control offers where nothing says how far it may go. */
const UNKNOWN = 12;
/** How many depths a control offers at most. */
const MOST = 1000;

/** What is known of how large a plant is by its depth. */
export type Sizes = Pick<GrammarReport, "sizes" | "ends" | "depth">;

/** The greatest depth that a control offers: somewhat beyond what the text asks for, but no further than the budget goes. */
export function deepest({ sizes, ends, depth }: Sizes, now: number): number {
  const wished = depth === null ? UNKNOWN : Math.ceil(depth * 1.5) + 2;
  const most = ends !== null && sizes.length > 0 ? Math.min(wished, sizes.length - 1) : wished;
  return Math.min(MOST, Math.max(1, now, most));
}

/** How many internodes the plant has at a depth; where that was not computed, as it goes on from the last two. */
export function internodesAt({ sizes }: Sizes, depth: number): { count: number; isGuess: boolean } | null {
  const known = sizes[depth];
  if (known) {
    return { count: known.internodes, isGuess: false };
  }
  const [last, before] = [sizes[sizes.length - 1], sizes[sizes.length - 2]];
  if (!last || !before || before.internodes === 0) {
    return null;
  }
  const steps = depth - (sizes.length - 1);
  const ratio = last.internodes / before.internodes;
  // Plants that grow by a constant number of internodes do not grow faster and faster.
  const even = last.internodes + steps * (last.internodes - before.internodes);
  const third = sizes[sizes.length - 3];
  const ratioBefore = third && third.internodes > 0 ? before.internodes / third.internodes : ratio;
  const isEven = ratio < 1.15 || ratio < 0.97 * ratioBefore;
  return { count: Math.round(isEven ? even : last.internodes * ratio ** steps), isGuess: true };
}

/** The depths of a row of bars, each with its height from 0 to 1: sizes grow by factors, so heights go by their logarithms. */
export function bars(sizes: Sizes, most: number, wanted: number): { depth: number; height: number }[] {
  const stride = Math.max(1, Math.ceil((most + 1) / wanted));
  const depths = Array.from({ length: Math.floor(most / stride) + 1 }, (_, i) => i * stride);
  const counts = depths.map((depth) => internodesAt(sizes, depth)?.count ?? 0);
  const greatest = Math.log1p(Math.max(1, ...counts));
  return depths.map((depth, i) => ({ depth, height: Math.log1p(counts[i] ?? 0) / greatest }));
}
