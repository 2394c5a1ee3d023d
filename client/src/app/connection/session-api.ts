import type { NewSession, SessionCreated } from "../../wire/generated";
import { ask, RequestFailed } from "../requests/request";

/** Starts a session, empty or from a saved tree. */
export async function createSession(request: NewSession = {}): Promise<string> {
  const created = await ask<SessionCreated>("POST", "/api/sessions", request);
  return created.session;
}

/** Whether a session exists. */
export async function sessionExists(session: string): Promise<boolean> {
  try {
    await ask<SessionCreated>("GET", `/api/sessions/${encodeURIComponent(session)}`);
    return true;
  } catch (error) {
    if (error instanceof RequestFailed && error.status === 404) {
      return false;
    }
    throw error;
  }
}

/** Where a session's socket is. */
export function socketAddress(session: string, page: { protocol: string; host: string }): string {
  const scheme = page.protocol === "https:" ? "wss" : "ws";
  return `${scheme}://${page.host}/api/sessions/${encodeURIComponent(session)}/socket`;
}
