import type { PoseFrame } from "../../../wire/pose";
import type { BendPoses } from "./bend-poses";

/** The newest pose of each bend that is in progress in the session; it may arrive before there is a view (`BE5`). */
export class SharedPoses {
  #newest = new Map<number, PoseFrame>();
  #shown: BendPoses | null = null;

  /** Shows them from now on. */
  attach(shown: BendPoses): void {
    this.#shown = shown;
    for (const pose of this.#newest.values()) {
      shown.receive(pose);
    }
  }

  detach(): void {
    this.#shown = null;
  }

  receive(pose: PoseFrame): void {
    if (pose.motions.length > 0) {
      this.#newest.set(pose.bend, pose);
    } else {
      this.#newest.delete(pose.bend);
    }
    this.#shown?.receive(pose);
  }

  /** Poses end with the connection. */
  clear(): void {
    this.#newest.clear();
    this.#shown?.clear();
  }
}
