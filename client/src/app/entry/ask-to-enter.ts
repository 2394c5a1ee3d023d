import { sessionInPath } from "../connection/session-address";
import type { Trouble } from "../requests/request";

/** Where somebody comes in who is not let in yet (`AC3`). */
export const ENTRY_PATH = "/pair";

/** Leads from a page that may not come in to the one where that is asked for, and back afterwards. */
export function askToEnter({ reason }: Trouble, page: Pick<Location, "pathname" | "replace">): boolean {
  if (reason !== "not-let-in") {
    return false;
  }
  const back = sessionInPath(page.pathname) === null ? "" : `?to=${encodeURIComponent(page.pathname)}`;
  page.replace(`${ENTRY_PATH}${back}`);
  return true;
}
