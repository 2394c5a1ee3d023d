import { signal } from "@preact/signals";

/** How far something on its way has come; `total` is null where it is not known. */
export interface Progress {
  readonly bytes: number;
  readonly total: number | null;
  /** Whether it is still made where it comes from. */
  readonly isMaking?: boolean;
  /** How many others come before it there. */
  readonly ahead?: number;
}

/** Something large on its way to or from the server, one at a time: shown while it lasts, and can be given up. */
export class Transfer {
  /** Null where nothing is in progress. */
  readonly progress = signal<Progress | null>(null);
  #stop: AbortController | null = null;

  /** Runs it; null if it was given up, or one was in progress already. */
  async run<Result>(
    work: (signal: AbortSignal, tell: (progress: Progress) => void) => Promise<Result>,
  ): Promise<Result | null> {
    if (this.#stop) {
      return null;
    }
    const stop = new AbortController();
    this.#stop = stop;
    this.progress.value = { bytes: 0, total: null };
    try {
      return await work(stop.signal, (progress) => {
        if (!stop.signal.aborted) {
          this.progress.value = progress;
        }
      });
    } catch (error) {
      if (stop.signal.aborted) {
        return null;
      }
      throw error;
    } finally {
      this.#stop = null;
      this.progress.value = null;
    }
  }

  cancel(): void {
    this.#stop?.abort();
  }
}
