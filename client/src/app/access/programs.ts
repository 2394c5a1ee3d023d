import { signal } from "@preact/signals";
import type { ListedToken, MadeToken, NewToken } from "../../wire/generated";
import { gone } from "../requests/listing";
import type * as api from "./people-api";

export interface ProgramsOptions {
  readonly api: Pick<typeof api, "listTokens" | "makeToken" | "revokeToken">;
  /** Something was not done. */
  readonly failed: (error: unknown) => void;
}

/** A token that was just made, which is known here alone. */
export interface FreshToken extends MadeToken {
  readonly name: string;
}

/** Programs that may ask the server: those that act as whoever looks, or everybody's. */
export class Programs {
  readonly whose = signal<"own" | "all">("own");
  /** Newest first; null until they are known. */
  readonly list = signal<readonly ListedToken[] | null>(null);
  /** Why they are not known; null where nothing is wrong. */
  readonly failure = signal<unknown>(null);
  readonly fresh = signal<FreshToken | null>(null);
  /** Whether a token is being made. */
  readonly making = signal(false);
  #options: ProgramsOptions;
  #asked = 0;

  constructor(options: ProgramsOptions) {
    this.#options = options;
  }

  /** Asks which there are; where that fails, what was known stays. */
  async look(whose = this.whose.peek()): Promise<void> {
    const turn = ++this.#asked;
    if (whose !== this.whose.peek()) {
      this.whose.value = whose;
      this.list.value = null;
    }
    this.failure.value = null;
    try {
      const list = await this.#options.api.listTokens(whose);
      if (turn === this.#asked) {
        this.list.value = list;
      }
    } catch (error) {
      if (turn === this.#asked && this.list.peek() === null) {
        this.failure.value = error;
      }
    }
  }

  /** Lets a program act as whoever looks; true once the server has it. */
  async make(token: NewToken): Promise<boolean> {
    if (this.making.peek()) {
      return false;
    }
    this.making.value = true;
    let isMade = true;
    try {
      this.fresh.value = { ...(await this.#options.api.makeToken(token)), name: token.name };
    } catch (error) {
      this.#options.failed(error);
      isMade = false;
    }
    this.making.value = false;
    await this.look();
    return isMade;
  }

  async revoke(id: string): Promise<void> {
    try {
      await gone(this.#options.api.revokeToken(id));
      if (this.fresh.peek()?.id === id) {
        this.fresh.value = null;
      }
    } catch (error) {
      this.#options.failed(error);
    }
    await this.look();
  }
}
