import { signal } from "@preact/signals";
import type { Point } from "./ports";
import type { Point2 } from "./tools/outline";

/** An outline on the glass while it is drawn, in the world while the tree grows into it. */
export type Outline =
  | { readonly stage: "drawing"; readonly points: readonly Point2[] }
  | { readonly stage: "growing"; readonly places: readonly Point[] };

/** The lasso's outline, shown until the tree has filled it. */
export class OutlineTrace {
  readonly shown = signal<Outline | null>(null);
  /** The number of the command that grows it. */
  #command = 0;

  draw(points: readonly Point2[] | null): void {
    this.shown.value = points && { stage: "drawing", points: [...points] };
  }

  grow(places: readonly Point[], command: number): void {
    this.shown.value = { stage: "growing", places };
    this.#command = command;
  }

  /** The server has told how things stand: all commands up to `settled` are taken, so many steps are left. */
  told(settled: number, pendingSteps: number): void {
    if (this.shown.peek()?.stage === "growing" && settled >= this.#command && pendingSteps === 0) {
      this.clear();
    }
  }

  clear(): void {
    this.shown.value = null;
  }
}
