import type { SavedTree, SaveVersion, TreeVersion } from "../../wire/generated";
import { findSession } from "../connection/session-api";
import { RequestFailed } from "../requests/request";
import { findTree, saveVersion } from "./library-api";

/** The tree of the library that a session belongs to. */
export interface Belonging {
  /** As the library has it. */
  readonly tree: SavedTree;
  /** The version that the session began with, or was last saved as. */
  readonly version: number;
  /** Whether nothing was done in it since. */
  readonly saved: boolean;
}

/** What came of saving: a version; or none, for somebody saved another one meanwhile. */
export type Saving = { readonly version: TreeVersion } | { readonly overtaken: Belonging };

/** The tree that a session belongs to; null if there is none, or it was deleted. */
export async function belongingOf(session: string): Promise<Belonging | null> {
  const of = (await findSession(session))?.tree;
  if (of === undefined) {
    return null;
  }
  const tree = await findTree(of.id).catch((error: unknown) => {
    if (error instanceof RequestFailed && error.status === 404) {
      return null;
    }
    throw error;
  });
  return tree === null || tree.deleted_at !== undefined ? null : { tree, version: of.version, saved: of.saved };
}

/** Whether the tree has a version that the session does not come from. */
export function isOvertaken({ tree, version }: Belonging): boolean {
  return tree.version !== version;
}

/** The same, once a person wants to go on from the newest version all the same. */
export function regardless(belonging: Belonging): Belonging {
  return { ...belonging, version: belonging.tree.version };
}

/** Saves a session as the next version of its tree, unless somebody has done so before. */
export async function saveNext(belonging: Belonging, request: SaveVersion): Promise<Saving> {
  let now = belonging;
  while (!isOvertaken(now)) {
    try {
      return { version: await saveVersion(now.tree.id, request, now.tree.revision) };
    } catch (error) {
      if (!(error instanceof RequestFailed && error.problem.code === "stale")) {
        throw error;
      }
      // It may only have another name.
      now = { ...now, tree: await findTree(now.tree.id) };
    }
  }
  return { overtaken: now };
}
