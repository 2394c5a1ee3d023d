import type { ReadonlySignal } from "@preact/signals";
import type { Command, DocumentState } from "../../../wire/generated";
import type { GrowControl } from "./grow-control";

/** The parts of a page that growth comes from. */
export interface GrowthSources {
  readonly document: ReadonlySignal<DocumentState | null>;
  readonly outline: { readonly shown: ReadonlySignal<{ readonly stage: string } | null> };
  readonly growth: Pick<GrowControl, "deflection" | "release">;
  readonly tools: { endGrowth(): void };
  submit(command: Command): unknown;
}

/** Whether anything grows: through this page or through someone else. */
export function isGrowing({ document, outline, growth }: Pick<GrowthSources, "document" | "outline" | "growth">) {
  const pending = document.value?.pending_steps ?? 0;
  return pending > 0 || outline.shown.value?.stage === "growing" || growth.deflection.value !== 0;
}

/** Ends all growth, where it is: the lever's, a stroke's, and what is still to come of steps and outlines (`ST1`). */
export function stopGrowth(page: GrowthSources): void {
  page.growth.release();
  page.tools.endGrowth();
  page.submit({ kind: "stop" });
}
