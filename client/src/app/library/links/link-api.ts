import type { LinkRole, MadeLink, NewLink, TreeLink, TreeLock } from "../../../wire/generated";
import { ask } from "../../requests/request";

/** What lets people in for a tree alone, newest first. */
export function listLinks(tree: string): Promise<readonly TreeLink[]> {
  return ask<TreeLink[]>("GET", pathOf(tree));
}

/** Makes a link that lets one device in; its address is in this one answer. */
export function makeLink(tree: string, link: NewLink): Promise<MadeLink> {
  return ask<MadeLink>("POST", pathOf(tree), link);
}

/** Whoever came by it, or comes, may do that from now on. */
export function changeLink(tree: string, link: string, role: LinkRole): Promise<TreeLink> {
  return ask<TreeLink>("PATCH", `${pathOf(tree)}/${encodeURIComponent(link)}`, { role });
}

/** Whoever came by it is let in no longer. */
export async function revokeLink(tree: string, link: string): Promise<void> {
  await ask<undefined>("DELETE", `${pathOf(tree)}/${encodeURIComponent(link)}`);
}

/** Whether owners alone change a tree (`AC16`). */
export function findLock(tree: string): Promise<TreeLock> {
  return ask<TreeLock>("GET", lockOf(tree));
}

/** Owners alone change the tree from now on, or not any more. */
export function setLock(tree: string, locked: boolean): Promise<TreeLock> {
  return ask<TreeLock>(locked ? "PUT" : "DELETE", lockOf(tree));
}

function lockOf(tree: string): string {
  return `/api/v1/trees/${encodeURIComponent(tree)}/lock`;
}

function pathOf(tree: string): string {
  return `/api/v1/trees/${encodeURIComponent(tree)}/links`;
}
