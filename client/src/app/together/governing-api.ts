import type { GuestHere, KeptOut, RemovedPerson, TreeOwner } from "../../wire/generated";
import { ask } from "../requests/request";

/** Somebody is removed from a session and its tree (`AC17`). */
export function removePerson(session: string, person: number): Promise<RemovedPerson> {
  return ask<RemovedPerson>("DELETE", `${pathOf(session)}/people/${person}`);
}

/** Who of those in a session came by a link of a tree, and by which (`AC12`). */
export function listGuests(session: string): Promise<readonly GuestHere[]> {
  return ask<GuestHere[]>("GET", `${pathOf(session)}/guests`);
}

/** Who is kept out of a session and its tree, and can be let back. */
export function listRemovals(session: string): Promise<readonly KeptOut[]> {
  return ask<KeptOut[]>("GET", `${pathOf(session)}/removals`);
}

export async function letBack(session: string, removal: string): Promise<void> {
  await ask<undefined>("DELETE", `${pathOf(session)}/removals/${encodeURIComponent(removal)}`);
}

/** To whom the tree of a session was handed over (`AC18`). */
export function findOwner(session: string): Promise<TreeOwner> {
  return ask<TreeOwner>("GET", `${pathOf(session)}/owner`);
}

/** The tree of a session is handed over to somebody, or to nobody any more. */
export function handOver(session: string, person: number | null): Promise<TreeOwner> {
  const path = `${pathOf(session)}/owner`;
  return person === null ? ask<TreeOwner>("DELETE", path) : ask<TreeOwner>("PUT", path, { person });
}

function pathOf(session: string): string {
  return `/api/v1/sessions/${encodeURIComponent(session)}`;
}
