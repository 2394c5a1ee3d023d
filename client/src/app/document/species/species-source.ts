import { type ReadonlySignal, signal } from "@preact/signals";
import type { Species } from "../../../wire/generated";
import type { Clock } from "../../page/clock";

/** How long the first new attempt waits; each after it waits twice as long, up to the last. */
const RETRY_FIRST = 1000;
const RETRY_LAST = 30_000;

export interface SpeciesSourceOptions {
  readonly list: () => Promise<readonly Species[]>;
  readonly clock: Clock;
}

/** The species of the server: asked for until it answers. */
export class SpeciesSource {
  /** Null before the server has answered. */
  readonly known: ReadonlySignal<readonly Species[] | null>;
  #known = signal<readonly Species[] | null>(null);
  #options: SpeciesSourceOptions;
  #asking = false;

  constructor(options: SpeciesSourceOptions) {
    this.#options = options;
    this.known = this.#known;
  }

  /** Asks the server unless that was done; `failed` is called once, for the first attempt that fails. */
  ask(failed: (error: unknown) => void): void {
    if (this.#asking) {
      return;
    }
    this.#asking = true;
    void this.#attempt(RETRY_FIRST, failed);
  }

  async #attempt(wait: number, failed: (error: unknown) => void): Promise<void> {
    try {
      this.#known.value = await this.#options.list();
    } catch (error) {
      failed(error);
      const next = Math.min(RETRY_LAST, 2 * wait);
      this.#options.clock.after(wait, () => void this.#attempt(next, () => {}));
    }
  }
}
