/** The clock and its timers; tests bring their own. */
export interface Clock {
  now(): number;
  after(delay: number, run: () => void): () => void;
}

export const browserClock: Clock = {
  now: () => performance.now(),
  after: (delay, run) => {
    const timer = setTimeout(run, delay);
    return () => clearTimeout(timer);
  },
};
