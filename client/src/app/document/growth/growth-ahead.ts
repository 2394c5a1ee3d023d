import { type DocumentState, MAX_OUTLINE_STEPS } from "../../../wire/generated";
import type { GrowthAhead } from "../draft";

/**
 * The growth that is left; of an outline only the greatest number of steps is known. The trials of a design that is being
 * fitted are one step.
 */
export function growthAhead(
  document: Pick<DocumentState, "step" | "pending_steps" | "trials"> | null,
  growsOutline: boolean,
): GrowthAhead {
  const { step = 0, pending_steps: steps = 0, trials = 0 } = document ?? {};
  const pending = trials > 0 ? steps - trials + 1 : steps;
  return { step, pending: pending > 0 && growsOutline ? Math.max(pending, MAX_OUTLINE_STEPS) : pending };
}
