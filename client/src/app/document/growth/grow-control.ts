import { signal } from "@preact/signals";
import type { Command } from "../../../wire/generated";
import { type Backlog, GrowPacer } from "./grow-pacer";

export interface GrowControlOptions {
  /** Sends a command and gives its number; 0 if it is not sent. */
  readonly submit: (command: Command) => number;
  readonly ready: () => boolean;
  /** A number that no other operation of this client has. */
  readonly newGesture: () => number;
  /** Grow and ungrow commands that are not yet answered. */
  readonly unsettled: () => number;
  /** Steps accepted but not yet run, whoever asked for them. */
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

  /** Whether a finger or a key holds it. */
  get isHeld(): boolean {
    return this.#loop !== 0;
  }

  to(deflection: number): void {
    this.deflection.value = deflection;
    if (!this.isHeld) {
      this.#pacer.press(this.#options.newGesture());
      this.#loop = requestAnimationFrame(this.#beat);
      this.#letGo = this.#options.hold();
    }
  }

  /** Growth ends with the step that is under way. */
  release(): void {
    if (this.isHeld) {
      this.#letGo();
      if (this.#pacer.grows) {
        this.#options.submit({ kind: "stop" });
      }
    }
    cancelAnimationFrame(this.#loop);
    this.#loop = 0;
    this.deflection.value = 0;
  }

  /** The server reported how things stand. */
  reported(): void {
    this.#pacer.reported(this.#backlog());
  }

  /** Nothing is left to do of commands up to this one (`CM11`). */
  done(command: number): void {
    this.#pacer.done(command);
  }

  /** What was asked for is not known to this server, or not under its number. */
  forget(): void {
    this.#pacer.forget();
  }

  #backlog(): Backlog {
    const { unsettled, pendingSteps } = this.#options;
    return { unsettled: unsettled(), pendingSteps: pendingSteps() };
  }

  #beat = (now: number) => {
    this.#loop = requestAnimationFrame(this.#beat);
    const { ready, bud, submit } = this.#options;
    if (!ready()) {
      return;
    }
    const step = this.#pacer.tick(now, this.deflection.peek(), this.#backlog());
    if (step) {
      const row = bud();
      this.#pacer.sent(step, submit(step.kind === "grow" && row !== null ? { ...step, bud: row } : step));
    }
  };
}
