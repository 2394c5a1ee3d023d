import type { DesignKey } from "./design-model";
import { combinedCourse, isPoints, type Points } from "./function-course";

/** How a value is said relative to the inherited one. */
export type Relation = "offset" | "factor";

/** Numbers from one to another. */
export interface Range {
  readonly least: number;
  readonly most: number;
}

/** What leaves an inherited value as it is. */
export const NEUTRAL: Readonly<Record<Relation, number>> = { offset: 0, factor: 1 };

/** Values nearer to nothing have no share of anything. */
const NOTHING = 1e-6;
/** What is said relative to a function has few points, which fingers can tell apart: it may be off by this share. */
const FEW_POINTS = 0.02;

export function isRelation(status: string): status is Relation {
  return status === "offset" || status === "factor";
}

/** How far a relative value may go (`relative_range` in `server/design/src/edit.rs`). */
export function relativeRange({ least, most }: Range, relation: Relation): Range {
  return relation === "offset" ? { least: least - most, most: most - least } : { least: 0, most: 10 };
}

/** What a number becomes by one that is said relative to it, within the range of the parameter. */
export function withRelative(inherited: number, own: number, of: Range, relation: Relation): number {
  return within(relation === "offset" ? inherited + own : inherited * own, of);
}

/** What an inherited number or function becomes by one that is said relative to it. */
export function combined(inherited: unknown, own: unknown, of: DesignKey, relation: Relation): unknown {
  const join = (a: number, b: number) => withRelative(a, b, of, relation);
  if (typeof inherited === "number" && typeof own === "number") {
    return join(inherited, own);
  }
  return isPoints(inherited) && isPoints(own) ? combinedCourse(inherited, own, join) : inherited;
}

/** What is to be said relative to an inherited value so that what comes of both is as near as can be to another. */
export function relativeTo(inherited: unknown, value: unknown, of: DesignKey, relation: Relation): number | Points {
  const range = relativeRange(of, relation);
  const apart = (a: number, b: number) => {
    const share = Math.abs(a) < NOTHING ? NEUTRAL.factor : b / a;
    return round(within(relation === "offset" ? b - a : share, range));
  };
  if (typeof inherited === "number" && typeof value === "number") {
    return apart(inherited, value);
  }
  const [neutral, hasFunctions] = [NEUTRAL[relation], of.kind === "function"];
  if (isPoints(inherited) && isPoints(value)) {
    return combinedCourse(inherited, value, apart, FEW_POINTS).map(([t, one]) => [round(t), one]);
  }
  return hasFunctions
    ? [
        [0, neutral],
        [1, neutral],
      ]
    : neutral;
}

function within(value: number, { least, most }: Range): number {
  return Math.min(Math.max(value, least), most);
}

function round(value: number): number {
  return Math.round(value * 1e4) / 1e4;
}
