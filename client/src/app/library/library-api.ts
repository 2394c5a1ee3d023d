import type { ChangeTree, SavedTree, SaveTree, TreePage } from "../../wire/generated";
import { ask } from "../requests/request";

/** So many saved trees, newest first; those behind another page, if its `next` is given. */
export function listTrees(limit: number, after?: string): Promise<TreePage> {
  const page = new URLSearchParams({ limit: String(limit), ...(after === undefined ? {} : { after }) });
  return ask<TreePage>("GET", `/api/trees?${page}`);
}

/** Saves a session's plants in the library. */
export function saveTree(request: SaveTree): Promise<SavedTree> {
  return ask<SavedTree>("POST", "/api/trees", request);
}

export function renameTree(id: string, name: string): Promise<SavedTree> {
  const request: ChangeTree = { name };
  return ask<SavedTree>("PATCH", `/api/trees/${encodeURIComponent(id)}`, request);
}

export async function deleteTree(id: string): Promise<void> {
  await ask<undefined>("DELETE", `/api/trees/${encodeURIComponent(id)}`);
}
