import type {
  ChangeGroup,
  ChangePassword,
  ChangeUser,
  ListedGroup,
  ListedToken,
  ListedUser,
  MadeToken,
  NewGroup,
  NewToken,
  NewUser,
} from "../../wire/generated";
import { newClientKey } from "../connection/client-record";
import { ask } from "../requests/request";

const USERS = "/api/v1/users";
const GROUPS = "/api/v1/groups";
const TOKENS = "/api/v1/tokens";

/** Who can log in, by name (`AC19`). */
export function listUsers(): Promise<readonly ListedUser[]> {
  return ask<ListedUser[]>("GET", USERS);
}

export function addUser(user: NewUser): Promise<ListedUser> {
  return ask<ListedUser>("POST", USERS, user, { key: newClientKey() });
}

/** Refused where somebody else has changed them since `revision`. */
export function changeUser(id: string, change: ChangeUser, revision: number): Promise<ListedUser> {
  return ask<ListedUser>("PATCH", `${USERS}/${encodeURIComponent(id)}`, change, { revision });
}

export async function removeUser(id: string): Promise<void> {
  await ask<undefined>("DELETE", `${USERS}/${encodeURIComponent(id)}`);
}

export async function changeOwnPassword(change: ChangePassword): Promise<void> {
  await ask<undefined>("PUT", "/api/v1/me/password", change);
}

/** Groups by name, each with who is in it (`AC20`). */
export function listGroups(): Promise<readonly ListedGroup[]> {
  return ask<ListedGroup[]>("GET", GROUPS);
}

export function addGroup(group: NewGroup): Promise<ListedGroup> {
  return ask<ListedGroup>("POST", GROUPS, group, { key: newClientKey() });
}

export function changeGroup(id: string, change: ChangeGroup, revision: number): Promise<ListedGroup> {
  return ask<ListedGroup>("PATCH", `${GROUPS}/${encodeURIComponent(id)}`, change, { revision });
}

export async function removeGroup(id: string): Promise<void> {
  await ask<undefined>("DELETE", `${GROUPS}/${encodeURIComponent(id)}`);
}

/** Somebody is in a group from now on, or not any more. */
export function setMember(group: string, user: string, isIn: boolean): Promise<ListedGroup> {
  const path = `${GROUPS}/${encodeURIComponent(group)}/members/${encodeURIComponent(user)}`;
  return ask<ListedGroup>(isIn ? "PUT" : "DELETE", path);
}

/** Programs that act as whoever asks, newest first; or everybody's (`AC21`). */
export function listTokens(whose: "own" | "all"): Promise<readonly ListedToken[]> {
  return ask<ListedToken[]>("GET", whose === "own" ? TOKENS : `${TOKENS}/all`);
}

/** Lets a program act as oneself; what it comes in with is in this one answer. */
export function makeToken(token: NewToken): Promise<MadeToken> {
  return ask<MadeToken>("POST", TOKENS, token);
}

export async function revokeToken(id: string): Promise<void> {
  await ask<undefined>("DELETE", `${TOKENS}/${encodeURIComponent(id)}`);
}
