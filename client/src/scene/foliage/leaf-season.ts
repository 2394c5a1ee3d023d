import type { LeafKind } from "../../wire/generated";
import { isSpray } from "../painting/lamina";

/** What a time of the year does to leaves, each number 0 to 1. */
export interface Season {
  /** How large they are. */
  readonly unfolded: number;
  /** How many of them there are. */
  readonly present: number;
  /** How young their green is. */
  readonly fresh: number;
  /** How far the colours of autumn have come. */
  readonly turned: number;
  /** How far they have died. */
  readonly withered: number;
}

/** Dead leaves that some trees keep until spring. */
const KEPT: Partial<Record<LeafKind, number>> = { lobed: 0.06, ovate: 0.03 };

/** 0 bud burst, 1 summer, 2 autumn, 3 winter. */
export function seasonOf(kind: LeafKind, season: number): Season {
  const spring = 1 - smooth(0, 0.95, season);
  const winter = smooth(1.9, 2.9, season);
  if (isSpray(kind)) {
    // New shoots are lighter for a while, and the cold dulls the old ones.
    return { unfolded: 1 - 0.06 * spring, present: 1, fresh: 0.5 * spring, turned: 0, withered: 0.16 * winter };
  }
  const burst = 0.4 + 0.6 * smooth(0, 0.6, season);
  const early = 0.2 * smooth(1.5, 2, season);
  const kept = KEPT[kind] ?? 0;
  const late = (0.8 - kept) * smooth(2, 2.85, season);
  return {
    unfolded: 0.24 + 0.76 * smooth(0, 0.85, season),
    present: burst - early - late,
    fresh: spring,
    turned: smooth(1.1, 2.2, season),
    withered: winter,
  };
}

/** 0 up to `from`, 1 from `to` on. */
function smooth(from: number, to: number, value: number): number {
  const t = Math.min(1, Math.max(0, (value - from) / (to - from)));
  return t * t * (3 - 2 * t);
}
