import type { Reason } from "../../wire/generated";

/** How long after a command found no room it is sent again, in milliseconds; twice as long after each further try, */
const AGAIN_FIRST = 250;
/** and so long at most. */
const AGAIN_LAST = 2000;

/** Numbers of commands, both ends included. */
export interface Run {
  readonly from: number;
  readonly to: number;
}

/**
 * Commands for which the server had no room (`LM23`): none is sent until the first of them is taken, then ever more at
 * once, so that they are done in their order.
 */
export class Backlog {
  /** The first that waits; null while all may go out. */
  #first: number | null = null;
  /** The last that was sent. */
  #sent = 0;
  /** Whether refusals of what was sent after the first are still on their way. */
  #draining = false;
  /** How many go out at once. */
  #most = 1;
  #wait = AGAIN_FIRST;
  #again: number | null = null;
  #since: number | null = null;

  /** Whether commands are held back. */
  get holds(): boolean {
    return this.#first !== null;
  }

  /** Since when they are held back, in the clock of the calls. */
  get since(): number | null {
    return this.#since;
  }

  /** When `due` is next to be asked. */
  get again(): number | null {
    return this.#again;
  }

  /** A command went out. */
  sent(number: number): void {
    this.#sent = Math.max(this.#sent, number);
  }

  /** Whether a refusal says no more than that a command waits. */
  refused(now: number, number: number, reason: Reason): boolean {
    if (reason === "behind") {
      this.#since ??= now;
      const isStuck = number === this.#first;
      this.#wait = isStuck ? Math.min(2 * this.#wait, AGAIN_LAST) : AGAIN_FIRST;
      this.#first = number;
      this.#most = 1;
      this.#draining = number < this.#sent;
      this.#rest(now);
      return true;
    }
    if (!this.#draining || this.#first === null || number <= this.#first) {
      return false;
    }
    // A gap: the one before it was not taken.
    this.#draining = number < this.#sent;
    this.#rest(now);
    return true;
  }

  /** All commands up to a number are taken or refused for good, of those up to `last` that there are. */
  answered(now: number, through: number, last: number): void {
    if (this.#first === null || this.#draining || this.#sent < this.#first || through < this.#sent) {
      return;
    }
    if (this.#sent >= last) {
      this.forget();
      return;
    }
    this.#first = this.#sent + 1;
    this.#most *= 2;
    this.#again = now;
  }

  /** Those that are to be sent now, of those up to `last` that there are. */
  due(now: number, last: number): Run | null {
    if (this.#first === null || this.#again === null || now < this.#again) {
      return null;
    }
    this.#again = null;
    return { from: this.#first, to: Math.min(this.#first + this.#most - 1, last) };
  }

  /** Tries again without waiting, with one command, where nothing is on its way. */
  hurry(now: number): void {
    if (this.#again !== null) {
      this.#most = 1;
      this.#again = now;
    }
  }

  /** Nothing waits here any more: it is done, or is sent again after a welcome. */
  forget(): void {
    this.#first = null;
    this.#sent = 0;
    this.#draining = false;
    this.#again = null;
    this.#since = null;
  }

  /** Once nothing is on its way any more, the first is tried again in a while. */
  #rest(now: number): void {
    if (!this.#draining && this.#first !== null) {
      this.#sent = this.#first - 1;
      this.#again = now + this.#wait;
    }
  }
}
