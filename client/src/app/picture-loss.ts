import type { Signal } from "@preact/signals";
import type { Hindrance } from "./studio";

/** For so long nothing is said, in milliseconds: most devices give the picture back within a moment. */
const PATIENCE = 2500;

/** Says that there is no picture any more, once it has been gone for a while. */
export class PictureLoss {
  #hindrance: Signal<Hindrance | null>;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(hindrance: Signal<Hindrance | null>) {
    this.#hindrance = hindrance;
  }

  /** The graphics card has taken the picture away (true), or there is one again. */
  readonly tell = (lost: boolean): void => {
    this.stop();
    if (lost) {
      this.#timer = setTimeout(() => {
        // What else is in the way has its own way on.
        this.#hindrance.value ??= "no-picture";
      }, PATIENCE);
    } else if (this.#hindrance.peek() === "no-picture") {
      this.#hindrance.value = null;
    }
  };

  /** Says nothing more. */
  stop(): void {
    clearTimeout(this.#timer);
  }
}
