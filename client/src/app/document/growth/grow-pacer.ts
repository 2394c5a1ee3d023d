import type { Command } from "../../../wire/generated";

/** Steps per second just off the centre, and at the end of the way. */
const SLOWEST = 1;
export const FASTEST = 8;
/** Steps per second while a key is held. */
export const KEY_RATE = 3;
/** The part of the way around the centre that means rest. */
const DEAD_ZONE = 0.12;

/** What the server has still to do. */
export interface Backlog {
  /** Grow and ungrow commands that are not yet answered. */
  readonly unsettled: number;
  /** Steps accepted but not yet run. */
  readonly pendingSteps: number;
}

/** Steps per second for a deflection from −1 to 1; below 0 it grows backwards. */
export function growthRate(deflection: number): number {
  const way = (Math.min(1, Math.abs(deflection)) - DEAD_ZONE) / (1 - DEAD_ZONE);
  return way < 0 ? 0 : Math.sign(deflection) * SLOWEST * (FASTEST / SLOWEST) ** way;
}

/** The deflection that gives so many steps per second. */
export function deflectionFor(rate: number): number {
  return DEAD_ZONE + ((1 - DEAD_ZONE) * Math.log(rate / SLOWEST)) / Math.log(FASTEST / SLOWEST);
}

/** Turns a held control into `grow` and `ungrow` commands of one step: each waits until the one before is done. */
export class GrowPacer {
  #gesture = 0;
  #owed = 0;
  #time: number | null = null;
  #rate = 0;
  /** The step asked for that is not known to be done, and the number of its command. */
  #open: { readonly kind: Command["kind"]; readonly number: number } | null = null;

  /** Whether a step of growth was asked for that may still be done. */
  get grows(): boolean {
    return this.#open?.kind === "grow";
  }

  /** A step was sent as the command of this number; 0 if it was not sent. */
  sent({ kind }: Command, number: number): void {
    this.#open = number > 0 ? { kind, number } : null;
  }

  /** The server reported how things stand, after everything that is answered. */
  reported({ unsettled, pendingSteps }: Backlog): void {
    if (unsettled === 0 && pendingSteps === 0) {
      this.#open = null;
    }
  }

  /** Nothing is left to do of commands up to this one (`CM11`), also of those that came to nothing. */
  done(number: number): void {
    if (this.#open !== null && number >= this.#open.number) {
      this.#open = null;
    }
  }

  /** The server knows nothing of what was asked for. */
  forget(): void {
    this.#open = null;
  }

  /** The control is taken; all growth until it is released is one operation for undo. */
  press(gesture: number): void {
    this.#gesture = gesture;
    this.#time = null;
    this.#owed = 0;
    this.#rate = 0;
  }

  /** What to send now, if anything. */
  tick(now: number, deflection: number, backlog: Backlog): Command | null {
    const rate = growthRate(deflection);
    const speed = Math.abs(rate);
    if (Math.sign(rate) !== Math.sign(this.#rate)) {
      // The first step follows the pointer at once.
      this.#owed = speed > 0 ? 1 : 0;
      this.#time = now;
    }
    this.#rate = rate;
    const elapsed = (now - (this.#time ?? now)) / 1000;
    this.#time = now;
    // Steps that could not be asked for in time are forgone, so that growth stops when the user does.
    this.#owed = Math.min(this.#owed + elapsed * speed, 1);
    const { unsettled, pendingSteps } = backlog;
    const isFree = unsettled === 0 && pendingSteps === 0 && this.#open === null;
    if (!isFree || this.#owed < 1 - 1e-9) {
      return null;
    }
    this.#owed = 0;
    return rate > 0 ? { kind: "grow", steps: 1, gesture: this.#gesture } : { kind: "ungrow", steps: 1 };
  }
}
