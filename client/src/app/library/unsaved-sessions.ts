import type { ListedSession, SessionPage, Way } from "../../wire/generated";
import { ask } from "../requests/request";
import type { UnsavedTree } from "./unsaved-tree";

/** So many are listed. */
const MOST = 100;

/** The server draws a tree of so many metamers at most for its card, and so many pixels along each side. */
const DRAWN = 30_000;
const SIDE = 240;

/** A tree that was left and not saved, as the server lists it. */
export interface LeftTree extends UnsavedTree {
  /** What the tree of the library is called that it goes on with. */
  readonly of?: string;
  /** Clients that are in it now. */
  readonly people: number;
}

/**
 * The trees that are not saved, those first that were worked on last (`LB11`): one's own where one has logged in, else
 * all that one may see, for a laptop and a tablet of one person are two devices then. What this device remembers gives
 * them their pictures.
 */
export async function unsavedSessions(
  way: Way | undefined,
  remembered: readonly UnsavedTree[],
): Promise<readonly LeftTree[]> {
  const query = new URLSearchParams({ saved: "false", limit: String(MOST), ...(way === "login" && { mine: "true" }) });
  const { sessions } = await ask<SessionPage>("GET", `/api/v1/sessions?${query}`);
  return sessions.filter(({ metamers }) => metamers > 0).map((session) => leftTree(session, remembered));
}

/** Takes a session off the list; its link leads to it still. */
export async function forgetSession(session: string): Promise<void> {
  await ask<undefined>("DELETE", `/api/v1/sessions/${encodeURIComponent(session)}`);
}

function leftTree(listed: ListedSession, remembered: readonly UnsavedTree[]): LeftTree {
  const { session, metamers, used_at: left, people, tree } = listed;
  const picture = remembered.find((other) => other.session === session)?.thumbnail;
  const thumbnail = picture ?? (tree ? pictureOfTree(tree) : pictureOfSession(session, metamers));
  return { session, metamers, left, people, ...(tree && { of: tree.name }), ...(thumbnail && { thumbnail }) };
}

function pictureOfTree({ id, version }: NonNullable<ListedSession["tree"]>): string {
  return `/api/v1/trees/${encodeURIComponent(id)}/versions/${version}/thumbnail`;
}

/** What no device remembers the server draws; of a large tree that takes others' time, and a drawing stands for it. */
function pictureOfSession(session: string, metamers: number): string | undefined {
  return metamers > DRAWN ? undefined : `/api/v1/sessions/${encodeURIComponent(session)}/tree.png?size=${SIDE}x${SIDE}`;
}
