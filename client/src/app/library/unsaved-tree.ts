/** A tree that was left and not saved: the server keeps its session, and this device how to find it. */
export interface UnsavedTree {
  readonly session: string;
  readonly metamers: number;
  /** When it was left, as ISO 8601 has it. */
  readonly left: string;
  /** A small picture as a data URL. */
  readonly thumbnail?: string;
}

/** What was saved of a session. */
export interface SavedState {
  readonly session: string;
  readonly mark: string;
}

/** Whether something read from the store is such a list. */
export function areUnsavedTrees(value: unknown): boolean {
  return Array.isArray(value) && value.every(isUnsavedTree);
}

/** Whether something read from the store is what was saved of a session. */
export function isSavedState(value: unknown): boolean {
  return isRecord(value) && typeof value.session === "string" && typeof value.mark === "string";
}

function isUnsavedTree(value: unknown): boolean {
  return (
    isRecord(value) &&
    typeof value.session === "string" &&
    typeof value.metamers === "number" &&
    typeof value.left === "string" &&
    (value.thumbnail === undefined || typeof value.thumbnail === "string")
  );
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}
