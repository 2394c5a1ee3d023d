import type { BendFrame } from "../../../wire/bend-frame";
import type { OthersBends } from "./others-bends";

/** The newest frame of each bend that is in progress in the session; it may arrive before there is a view (`BE5`). */
export class SharedBends {
  #newest = new Map<number, BendFrame>();
  #shown: OthersBends | null = null;

  /** Shows them from now on. */
  attach(shown: OthersBends): void {
    this.#shown = shown;
    for (const frame of this.#newest.values()) {
      shown.receive(frame);
    }
  }

  detach(): void {
    this.#shown = null;
  }

  receive(frame: BendFrame): void {
    if (frame.motions.length > 0) {
      this.#newest.set(frame.bend, frame);
    } else {
      this.#newest.delete(frame.bend);
    }
    this.#shown?.receive(frame);
  }

  /** They end with the connection. */
  clear(): void {
    this.#newest.clear();
    this.#shown?.clear();
  }
}
