import type { Parameters } from "../../../wire/generated";
import { NUMBERS } from "./growth-parameters";
import { changesOf, type ProgrammeInForce, valuesAt } from "./programme-control";

/** Above it nearly everything is shed: it is where the part of the range ends in which shedding differs most. */
const NEARLY_ALL = NUMBERS.shedding_threshold.travel?.[1] ?? NUMBERS.shedding_threshold.most;

/** A young stage of a programme that sheds nearly all branches. */
export interface YoungShedding {
  /** The age at which it ends. */
  readonly until: number;
  /** The shedding threshold from then on. */
  readonly later: number;
}

/** The young stage that will shed what is drawn at an age; null where the tree keeps it. */
export function youngShedding(
  { programme, byHand }: ProgrammeInForce,
  age: number,
  { shedding_threshold: now }: Parameters,
): YoungShedding | null {
  if (now <= NEARLY_ALL || byHand.includes("shedding_threshold")) {
    return null;
  }
  for (const change of changesOf(programme)) {
    const later = valuesAt(programme, change.age).shedding_threshold;
    if (change.age > age && later <= NEARLY_ALL) {
      return { until: change.age, later };
    }
  }
  return null;
}
