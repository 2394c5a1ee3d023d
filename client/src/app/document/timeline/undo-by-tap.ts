import type { ReadonlySignal } from "@preact/signals";
import type { Command, DocumentState, Timeline } from "../../../wire/generated";
import type { Toasts } from "../../page/toasts";
import { say } from "../../words/say";

/** The parts of a page that a tap of several fingers concerns. */
export interface UndoTargets {
  readonly document: ReadonlySignal<Pick<DocumentState, "can_undo" | "can_redo"> | null>;
  readonly time: { readonly timeline: ReadonlySignal<Timeline | null> };
  readonly toasts: Pick<Toasts, "show">;
  submit(command: Command): void;
}

/** Two fingers undo and three redo, as in drawing programs; a tap is easily made unawares, so it says what it did. */
export function undoByTap(page: UndoTargets, fingers: number): void {
  const kind = { 2: "undo", 3: "redo" }[fingers];
  const document = page.document.peek();
  if (!document || (kind !== "undo" && kind !== "redo")) {
    return;
  }
  if (!document[`can_${kind}`]) {
    page.toasts.show(say(`operations.${kind}.none`));
    return;
  }
  const timeline = page.time.timeline.peek();
  const operation = timeline && operationOf(timeline, kind);
  page.submit({ kind });
  if (operation) {
    page.toasts.show(say(`operations.${kind === "undo" ? "undone" : "redone"}`, { what: say(operation) }));
  }
}

/** The name of what is undone or redone next. */
function operationOf({ operations, done, step }: Timeline, kind: "undo" | "redo") {
  const current = operations[done - 1];
  // Where a journey in time has stopped within an operation, redo goes to its end.
  const isInPart = current !== undefined && step < current.last;
  const operation = kind === "undo" || isInPart ? current : operations[done];
  return operation && (`operations.kind.${operation.kind}` as const);
}
