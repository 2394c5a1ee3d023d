import { type DocumentState, MAX_OUTLINE_STEPS } from "../../../wire/generated";
import type { GrowthAhead } from "../draft";

/** The growth that is left; of an outline only the greatest number of steps is known. */
export function growthAhead(
  document: Pick<DocumentState, "step" | "pending_steps"> | null,
  growsOutline: boolean,
): GrowthAhead {
  const { step = 0, pending_steps: pending = 0 } = document ?? {};
  return { step, pending: pending > 0 && growsOutline ? Math.max(pending, MAX_OUTLINE_STEPS) : pending };
}
