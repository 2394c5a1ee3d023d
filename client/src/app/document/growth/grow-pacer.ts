import type { Command } from "../../../wire/generated";

/** Steps per second just off the centre, and at the end of the way. */
const SLOWEST = 1;
export const FASTEST = 8;
/** Steps per second while a key is held. */
export const KEY_RATE = 3;
/** The part of the way around the centre that means rest. */
const DEAD_ZONE = 0.12;
/** After so many milliseconds in which the server has nothing to do, a step of which it reported nothing has come to nothing. */
const SILENCE = 400;

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
  /** The step asked for that is not known to be done. */
  #open: "grow" | "ungrow" | null = null;
  /** Since when the server has had nothing to do. */
  #idleSince: number | null = null;

  /** Whether a step of growth was asked for that may still be done. */
  get grows(): boolean {
    return this.#open === "grow";
  }

  /** The server reported how things stand, after everything that is answered. */
  reported({ unsettled, pendingSteps }: Backlog): void {
    if (unsettled === 0 && pendingSteps === 0) {
      this.#open = null;
    }
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
    if (!this.#isFree(now, backlog) || this.#owed < 1 - 1e-9) {
      return null;
    }
    this.#owed = 0;
    this.#idleSince = null;
    this.#open = rate > 0 ? "grow" : "ungrow";
    return rate > 0 ? { kind: "grow", steps: 1, gesture: this.#gesture } : { kind: "ungrow", steps: 1 };
  }

  #isFree(now: number, { unsettled, pendingSteps }: Backlog): boolean {
    if (unsettled > 0 || pendingSteps > 0) {
      this.#idleSince = null;
      return false;
    }
    this.#idleSince ??= now;
    if (now - this.#idleSince >= SILENCE) {
      this.#open = null;
    }
    return this.#open === null;
  }
}
