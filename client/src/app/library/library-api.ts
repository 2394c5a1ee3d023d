import type { RenameTree, SavedTree, SaveTree } from "../../wire/generated";
import { ask } from "../requests/request";

/** What a page of the library begins behind: the last tree of the page before, which may be gone by now. */
export type Behind = Pick<SavedTree, "id" | "saved_at">;

/** So many saved trees, newest first; behind the one named, if one is. */
export function listTrees(limit: number, behind?: Behind): Promise<SavedTree[]> {
  const page = new URLSearchParams({ limit: String(limit) });
  if (behind !== undefined) {
    page.set("behind", behind.id);
    page.set("saved_at", behind.saved_at);
  }
  return ask<SavedTree[]>("GET", `/api/trees?${page}`);
}

/** Saves a session's plants in the library. */
export function saveTree(request: SaveTree): Promise<SavedTree> {
  return ask<SavedTree>("POST", "/api/trees", request);
}

export function renameTree(id: string, name: string): Promise<SavedTree> {
  const request: RenameTree = { name };
  return ask<SavedTree>("PATCH", `/api/trees/${encodeURIComponent(id)}`, request);
}

export async function deleteTree(id: string): Promise<void> {
  await ask<undefined>("DELETE", `/api/trees/${encodeURIComponent(id)}`);
}
