import type { NewMember, TreeMember } from "../../../wire/generated";
import { ask } from "../../requests/request";

/** What is given: a tree, or a collection with all that lies in it. */
export interface Gift {
  readonly kind: "tree" | "collection";
  readonly id: string;
  readonly name: string;
}

/** To whom it was given itself (`AC22`). */
export function listMembers(gift: Gift): Promise<readonly TreeMember[]> {
  return ask<TreeMember[]>("GET", pathOf(gift));
}

/** Gives it to somebody; who has it already has this role from now on. */
export function addMember(gift: Gift, member: NewMember): Promise<TreeMember> {
  return ask<TreeMember>("POST", pathOf(gift), member);
}

export async function removeMember(gift: Gift, member: string): Promise<void> {
  await ask<undefined>("DELETE", `${pathOf(gift)}/${encodeURIComponent(member)}`);
}

function pathOf({ kind, id }: Gift): string {
  return `/api/v1/${kind}s/${encodeURIComponent(id)}/members`;
}
