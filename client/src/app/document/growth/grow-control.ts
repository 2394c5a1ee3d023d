import { signal } from "@preact/signals";
import type { Command } from "../../../wire/generated";
import { GrowPacer, growthRate } from "./grow-pacer";

export interface GrowControlOptions {
  /** Sends a command, if there is a server to take it. */
  readonly submit: (command: Command) => void;
  readonly ready: () => boolean;
  /** A number that no other operation of this client has. */
  readonly newGesture: () => number;
  /** Grow and ungrow commands that are not yet answered. */
  readonly unsettled: () => number;
  readonly pendingSteps: () => number;
  /** The branch that alone may grow, as a row (`SG1`). */
  readonly bud: () => number | null;
  /** The control is taken; lets go of it when what this returns is called. */
  readonly hold: () => () => void;
}

/** The lever that lets the tree grow on alone, or backwards. */
export class GrowControl {
  /** From −1 to 1. */
  readonly deflection = signal(0);
  #options: GrowControlOptions;
  #pacer = new GrowPacer();
  #loop = 0;
  #letGo = () => {};

  constructor(options: GrowControlOptions) {
    this.#options = options;
  }

  to(deflection: number): void {
    this.deflection.value = deflection;
    if (this.#loop === 0) {
      this.#pacer.press(this.#options.newGesture());
      this.#loop = requestAnimationFrame(this.#beat);
      this.#letGo = this.#options.hold();
    }
  }

  release(): void {
    if (this.#loop !== 0) {
      this.#letGo();
    }
    cancelAnimationFrame(this.#loop);
    this.#loop = 0;
    this.deflection.value = 0;
  }

  #beat = (now: number) => {
    this.#loop = requestAnimationFrame(this.#beat);
    const { ready, unsettled, pendingSteps, bud, submit } = this.#options;
    if (!ready()) {
      return;
    }
    const deflection = this.deflection.peek();
    const command = this.#pacer.tick(now, deflection, {
      unsettled: unsettled(),
      pendingSteps: growthRate(deflection) > 0 ? pendingSteps() : 0,
    });
    const row = bud();
    if (command) {
      submit(command.kind === "grow" && row !== null ? { ...command, bud: row } : command);
    }
  };
}
