import type {
  ChangeCollection,
  ChangeTree,
  ChangeVersion,
  CopyTree,
  NewCollection,
  RestoreVersion,
  SavedTree,
  SaveTree,
  SaveVersion,
  TreeAuthor,
  TreeCollection,
  TreePage,
  TreeTag,
  TreeVersion,
} from "../../wire/generated";
import { ask } from "../requests/request";
import type { Page } from "./pages";
import type { asked } from "./wanted";

/** Which trees are listed: all that are not deleted, if nothing is said (`LB7`). */
export interface Which extends Partial<ReturnType<typeof asked>> {
  readonly template?: boolean;
  readonly deleted?: boolean;
}

/** So many saved trees, newest first if no order is asked for; those behind another page, if its `next` is given. */
export async function listTrees(limit: number, after?: string, which: Which = {}): Promise<Page<SavedTree>> {
  const { trees, next } = await ask<TreePage>("GET", `/api/v1/trees?${query({ limit, after, ...which })}`);
  return next === undefined ? { items: trees } : { items: trees, next };
}

/** A tree as it is now, also one that was deleted. */
export function findTree(id: string): Promise<SavedTree> {
  return ask<SavedTree>("GET", pathOf(id));
}

/** Saves a session's plants as a new tree. */
export function saveTree(request: SaveTree): Promise<SavedTree> {
  return ask<SavedTree>("POST", "/api/v1/trees", request);
}

/** Saves them as the next version of a tree, if that is at this revision still (`LB2`). */
export function saveVersion(id: string, request: SaveVersion, revision: number): Promise<TreeVersion> {
  return ask<TreeVersion>("POST", `${pathOf(id)}/versions`, request, { revision });
}

export function changeTree(id: string, change: ChangeTree): Promise<SavedTree> {
  return ask<SavedTree>("PATCH", pathOf(id), change);
}

/** Makes a new tree of one, or of one of its versions. */
export function copyTree(id: string, request: CopyTree): Promise<SavedTree> {
  return ask<SavedTree>("POST", `${pathOf(id)}/copies`, request);
}

export async function deleteTree(id: string): Promise<void> {
  await ask<undefined>("DELETE", pathOf(id));
}

/** Deletes one that was deleted, so that it cannot be taken back. */
export async function deleteTreeForGood(id: string): Promise<void> {
  await ask<undefined>("DELETE", `${pathOf(id)}/for-good`);
}

export function undeleteTree(id: string): Promise<SavedTree> {
  return ask<SavedTree>("POST", `${pathOf(id)}/undelete`);
}

/** So many versions, newest first; those before the number that another page ends with. */
export async function listVersions(id: string, limit: number, before?: string): Promise<Page<TreeVersion>> {
  const items = await ask<TreeVersion[]>("GET", `${pathOf(id)}/versions?${query({ limit, before })}`);
  const last = items.at(-1)?.number ?? 1;
  return last > 1 ? { items, next: String(last) } : { items };
}

export function changeVersion(id: string, number: number, change: ChangeVersion): Promise<TreeVersion> {
  return ask<TreeVersion>("PATCH", `${pathOf(id)}/versions/${number}`, change);
}

/** Saves what a version holds as the newest one. */
export function restoreVersion(id: string, number: number, request: RestoreVersion): Promise<TreeVersion> {
  return ask<TreeVersion>("POST", `${pathOf(id)}/versions/${number}/restore`, request);
}

/** Whether a tree is a favourite of this device's. */
export async function setFavourite(id: string, favourite: boolean): Promise<void> {
  await ask<undefined>(favourite ? "PUT" : "DELETE", `${pathOf(id)}/favourite`);
}

/** All tags that trees have. */
export function listTags(): Promise<readonly TreeTag[]> {
  return ask<TreeTag[]>("GET", "/api/v1/tags");
}

/** All who saved a tree last and said their name. */
export function listAuthors(): Promise<readonly TreeAuthor[]> {
  return ask<TreeAuthor[]>("GET", "/api/v1/authors");
}

/** All collections, by name. */
export function listCollections(): Promise<readonly TreeCollection[]> {
  return ask<TreeCollection[]>("GET", "/api/v1/collections");
}

export function addCollection(collection: NewCollection): Promise<TreeCollection> {
  return ask<TreeCollection>("POST", "/api/v1/collections", collection);
}

export function changeCollection(id: string, change: ChangeCollection): Promise<TreeCollection> {
  return ask<TreeCollection>("PATCH", `/api/v1/collections/${encodeURIComponent(id)}`, change);
}

export async function deleteCollection(id: string): Promise<void> {
  await ask<undefined>("DELETE", `/api/v1/collections/${encodeURIComponent(id)}`);
}

function pathOf(id: string): string {
  return `/api/v1/trees/${encodeURIComponent(id)}`;
}

function query(fields: Readonly<Record<string, string | number | boolean | undefined>>): string {
  const asked = Object.entries(fields).flatMap(([name, value]) =>
    value === undefined ? [] : [[name, String(value)] as [string, string]],
  );
  return new URLSearchParams(asked).toString();
}
