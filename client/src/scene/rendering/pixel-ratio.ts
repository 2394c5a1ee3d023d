/** Calls back when the page comes to a screen with other pixels, which changes no size of the page; returns what ends it. */
export function followPixelRatio(changed: () => void): () => void {
  const stop = new AbortController();
  const watch = () => {
    // A query knows one ratio; with each other one it is asked anew.
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener(
      "change",
      () => {
        changed();
        watch();
      },
      { once: true, signal: stop.signal },
    );
  };
  watch();
  return () => stop.abort();
}
