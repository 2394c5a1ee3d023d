import type { DocumentState } from "../../../wire/generated";
import type { GrowthAhead } from "../draft";

/** An outline grows for so many steps at most (`LA1`). */
const OUTLINE_STEPS = 400;

/** The growth that is left; of an outline only the greatest number of steps is known. */
export function growthAhead(
  document: Pick<DocumentState, "step" | "pending_steps"> | null,
  growsOutline: boolean,
): GrowthAhead {
  const { step = 0, pending_steps: pending = 0 } = document ?? {};
  return { step, pending: pending > 0 && growsOutline ? Math.max(pending, OUTLINE_STEPS) : pending };
}
