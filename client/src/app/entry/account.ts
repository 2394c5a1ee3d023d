import type { LogIn as Account, Entrance } from "../../wire/generated";
import { ask } from "../requests/request";
import { backTo } from "./invitation";

export type { Account };

/** What one can come in by; fails where the server does not say it. */
export function askEntrance(): Promise<Entrance> {
  return ask<Entrance>("GET", "/api/v1/entry");
}

/** What one can come in by; a server that does not say is asked for no password. */
export async function entrance(): Promise<Entrance> {
  return askEntrance().catch(() => ({ passwords: false }));
}

/** Comes in with a password; gives the path to go to. `search` is that of the page, which may name where from. */
export async function logIn(account: Account, search: string): Promise<string> {
  await ask("POST", "/api/v1/login", account);
  return backTo(search);
}

/** Has the server let this browser in no longer. */
export async function logOut(): Promise<void> {
  await ask("POST", "/api/v1/logout");
}
