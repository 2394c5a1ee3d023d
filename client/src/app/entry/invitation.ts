import type { Admitted, Redeem } from "../../wire/generated";
import { whoAmI } from "../access/rights";
import { pathOf, sessionInPath } from "../connection/session-address";
import { createSession } from "../connection/session-api";
import { ask, RequestFailed } from "../requests/request";

/** The secret in what somebody has scanned, opened or typed: a whole link, what stands behind its `#`, or that alone. */
export function secretIn(text: string): string {
  return text.slice(text.lastIndexOf("#") + 1).trim();
}

/** Comes in by an invitation; gives the path to go to. `search` is that of the page, which may name where from. */
export async function redeem(secret: string, search: string): Promise<string> {
  const tree = await admitted(secret);
  if (tree !== undefined) {
    return pathOf((await createSession({ tree })).session);
  }
  return backTo(search);
}

/** The path of the session that somebody came from, as the address of the page names it. */
export function backTo(search: string): string {
  const session = sessionInPath(new URLSearchParams(search).get("to") ?? "");
  return session === null ? "/" : pathOf(session);
}

/** The only tree of whoever comes in; who is in already may open the link of that time again. */
async function admitted(secret: string): Promise<string | undefined> {
  try {
    return (await ask<Admitted>("POST", "/api/v1/redeem", { secret } satisfies Redeem)).tree;
  } catch (error) {
    const me = error instanceof RequestFailed && error.problem.reason === "no-invitation" ? await whoAmI() : null;
    if (me === null) {
      throw error;
    }
    return me.tree;
  }
}
