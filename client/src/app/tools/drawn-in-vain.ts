import { signal } from "@preact/signals";
import type { Hint } from "../../wire/generated";
import type { Clock } from "../page/clock";

/** How long it is read, in milliseconds. */
const SHOWN_FOR = 4500;

/** What was drawn last where nothing can grow; it goes by itself once it has been read (`SG2`). */
export class DrawnInVain {
  readonly shown = signal<Hint | null>(null);
  #cancel = () => {};

  constructor(private readonly clock: Clock) {}

  show(hint: Hint): void {
    this.clear();
    this.shown.value = hint;
  }

  /** It is on the screen from now on: what shows it may have had to be loaded first. */
  seen(): void {
    this.#cancel();
    this.#cancel = this.clock.after(SHOWN_FOR, () => this.clear());
  }

  clear(): void {
    this.#cancel();
    this.shown.value = null;
  }
}
