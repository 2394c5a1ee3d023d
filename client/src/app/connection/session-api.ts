import type { NewSession, SessionCreated } from "../../wire/generated";
import { ask, RequestFailed } from "../requests/request";

/** Starts a session, empty or from a saved tree; or leads into the one in which that tree is (`LB3`). */
export function createSession(request: NewSession = {}): Promise<SessionCreated> {
  return ask<SessionCreated>("POST", "/api/v1/sessions", request);
}

/** A session by its name; null if there is none. */
export async function findSession(session: string): Promise<SessionCreated | null> {
  try {
    return await ask<SessionCreated>("GET", `/api/v1/sessions/${encodeURIComponent(session)}`);
  } catch (error) {
    if (error instanceof RequestFailed && error.status === 404) {
      return null;
    }
    throw error;
  }
}

/** Where a session's socket is, or that of a copy to play it in (`RP1`). */
export function socketAddress(
  session: string,
  page: { protocol: string; host: string },
  door: "socket" | "replay" = "socket",
): string {
  const scheme = page.protocol === "https:" ? "wss" : "ws";
  return `${scheme}://${page.host}/api/v1/sessions/${encodeURIComponent(session)}/${door}`;
}
