/**
 * Calls again and again, each time `milliseconds` after the call before has ended: a page that was held up neither
 * hurries afterwards nor makes up for what it missed. Returns what stops it.
 */
export function pace(milliseconds: number, act: () => void): () => void {
  let stopped = false;
  let timer = setTimeout(beat, milliseconds);
  function beat() {
    act();
    if (!stopped) {
      timer = setTimeout(beat, milliseconds);
    }
  }
  return () => {
    stopped = true;
    clearTimeout(timer);
  };
}
