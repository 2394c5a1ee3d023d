export interface PageEvents {
  /** The page is hidden or goes; it may never come back. */
  leaving(): void;
  /** It is shown again. */
  returning(): void;
  /** The network is back. */
  online(): void;
  /** The address has changed by the browser's own buttons. */
  navigated(): void;
}

/** Follows a page through hiding, returning and leaving; returns what ends it. */
export function followPageLife(events: PageEvents): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  const leaving = () => events.leaving();
  const returning = () => events.returning();
  addEventListener("pagehide", leaving, options);
  addEventListener("pageshow", returning, options);
  addEventListener("online", () => events.online(), options);
  document.addEventListener("visibilitychange", () => (document.hidden ? leaving : returning)(), options);
  addEventListener("popstate", () => events.navigated(), options);
  return () => stop.abort();
}
