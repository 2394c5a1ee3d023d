import { useEffect, useRef } from "preact/hooks";

/** Closes what is open at a press elsewhere or Escape, which then mean nothing else. */
export function useDismissal(host: { readonly current: HTMLElement | null }, open: boolean, close: () => void): void {
  const latest = useRef(close);
  latest.current = close;
  useEffect(() => {
    if (!open) {
      return undefined;
    }
    const stop = new AbortController();
    const dismiss = (event: Event) => {
      if (event instanceof KeyboardEvent ? event.key === "Escape" : !host.current?.contains(event.target as Node)) {
        event.stopPropagation();
        latest.current();
      }
    };
    addEventListener("pointerdown", dismiss, { capture: true, signal: stop.signal });
    addEventListener("keydown", dismiss, { capture: true, signal: stop.signal });
    return () => stop.abort();
  }, [host, open]);
}
