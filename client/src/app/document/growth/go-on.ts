import { ask } from "../../requests/request";

/** Has the server do what rests in a session because it did not outlive it (`OP5`). */
export function goOn(session: string): Promise<void> {
  return ask<undefined>("POST", `/api/v1/sessions/${encodeURIComponent(session)}/resume`);
}
