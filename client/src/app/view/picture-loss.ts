import { effect, type Signal, signal } from "@preact/signals";
import type { Hindrance } from "../page/hindrance";

/** For so long nothing is said, in milliseconds: most devices give the picture back within a moment. */
const PATIENCE = 2500;

/** Says that there is no picture any more, once it has been gone for a while, for as long as it is. */
export class PictureLoss {
  #hindrance: Signal<Hindrance | null>;
  #gone = signal(false);
  #timer: ReturnType<typeof setTimeout> | undefined;
  #unfollow: () => void;

  constructor(hindrance: Signal<Hindrance | null>) {
    this.#hindrance = hindrance;
    // What else is in the way has its own way on; when that is gone, or another tree is opened, there is still no picture.
    this.#unfollow = effect(() => {
      if (this.#gone.value && hindrance.value === null) {
        hindrance.value = "no-picture";
      }
    });
  }

  /** The graphics card has taken the picture away (true), or there is one again. */
  readonly tell = (lost: boolean): void => {
    clearTimeout(this.#timer);
    if (lost) {
      this.#timer = setTimeout(() => {
        this.#gone.value = true;
      }, PATIENCE);
      return;
    }
    this.#gone.value = false;
    if (this.#hindrance.peek() === "no-picture") {
      this.#hindrance.value = null;
    }
  };

  /** Says nothing more. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#unfollow();
  }
}
