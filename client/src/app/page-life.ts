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
  addEventListener("pagehide", events.leaving, options);
  addEventListener("pageshow", events.returning, options);
  addEventListener("online", events.online, options);
  document.addEventListener("visibilitychange", () => (document.hidden ? events.leaving : events.returning)(), options);
  addEventListener("popstate", events.navigated, options);
  return () => stop.abort();
}
