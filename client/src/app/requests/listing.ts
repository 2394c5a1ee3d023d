import { signal } from "@preact/signals";
import { say } from "../words/say";
import { RequestFailed } from "./request";

export interface ListingOptions<Answer> {
  readonly ask: () => Promise<Answer>;
  /** Something was not done, or it is not known how it stands after it. */
  readonly failed: (error: unknown) => void;
}

/** Something else is being done already. */
export class StillBusy extends Error {
  constructor() {
    super(say("controls.still-busy"));
    this.name = "StillBusy";
  }
}

/** What the server lists, as it was told last, and what is done to it, one thing at a time. */
export class Listing<Answer> {
  /** Null until it is known. */
  readonly known = signal<Answer | null>(null);
  /** Why it is not known; null where nothing is wrong. */
  readonly failure = signal<unknown>(null);
  /** Whether something is being done. */
  readonly busy = signal(false);
  readonly #options: ListingOptions<Answer>;
  /** Counts the questions: only the newest answer is taken. */
  #asked = 0;

  constructor(options: ListingOptions<Answer>) {
    this.#options = options;
  }

  /** Asks for it; where that fails, what was known stays. */
  async look(): Promise<void> {
    const error = await this.#look();
    if (error !== null && this.known.peek() === null) {
      this.failure.value = error;
    }
  }

  /**
   * Whether it was done; what went wrong is said, and how it stands now is asked in any case. What `act` gives says what
   * has changed: it is so also where nobody answers how it stands.
   */
  async do(act: () => Promise<((known: Answer) => Answer) | undefined>): Promise<boolean> {
    const { failed } = this.#options;
    if (this.busy.peek()) {
      failed(new StillBusy());
      return false;
    }
    this.busy.value = true;
    let isDone = false;
    try {
      const change = await act();
      isDone = true;
      const known = this.known.peek();
      if (change && known !== null) {
        this.known.value = change(known);
      }
    } catch (error) {
      failed(error);
    }
    const silence = await this.#look();
    if (isDone && silence !== null) {
      failed(silence);
    }
    this.busy.value = false;
    return isDone;
  }

  /** What went wrong; null where it was told, or something newer was asked. */
  async #look(): Promise<unknown> {
    const turn = ++this.#asked;
    this.failure.value = null;
    try {
      const answer = await this.#options.ask();
      if (turn === this.#asked) {
        this.known.value = answer;
      }
      return null;
    } catch (error) {
      return turn === this.#asked ? error : null;
    }
  }
}

/** What somebody else has removed already is removed. */
export async function gone(removal: Promise<unknown>): Promise<void> {
  try {
    await removal;
  } catch (error) {
    if (!(error instanceof RequestFailed && error.status === 404)) {
      throw error;
    }
  }
}
