import { signal } from "@preact/signals";
import type { Vec3 } from "../../../scene/vector";
import type { Point2 } from "./outline";

/** An outline on the screen while it is drawn, in the world while the tree grows into it. */
export type Outline =
  | { readonly stage: "drawing"; readonly points: readonly Point2[]; readonly repeated: readonly (readonly Point2[])[] }
  | { readonly stage: "growing"; readonly outlines: readonly (readonly Vec3[])[] };

/** The lasso's outline, shown until the tree has filled it. */
export class OutlineTrace {
  readonly shown = signal<Outline | null>(null);
  /** The number of the last command that grows it. */
  #command = 0;
  /** The steps left, by the last message of the server after the command was sent. */
  #left: number | null = null;

  draw(points: readonly Point2[] | null, repeated: readonly (readonly Point2[])[] = []): void {
    this.shown.value = points && { stage: "drawing", points: [...points], repeated };
  }

  /** Outlines are grown by commands up to this one. */
  grow(outlines: readonly (readonly Vec3[])[], command: number): void {
    this.shown.value = { stage: "growing", outlines };
    this.#command = command;
    this.#left = null;
  }

  /** All commands up to `settled` are answered, and so many steps are left to grow. */
  progressed(settled: number, pendingSteps: number): void {
    this.#left = pendingSteps;
    this.settled(settled);
  }

  /** All commands up to `settled` are answered. Growth that is quick ends before its command is acknowledged. */
  settled(settled: number): void {
    if (this.shown.peek()?.stage === "growing" && settled >= this.#command && this.#left === 0) {
      this.clear();
    }
  }

  clear(): void {
    this.shown.value = null;
  }
}
