import { signal } from "@preact/signals";
import type { Vec3 } from "../../../scene/vector";
import type { Command } from "../../../wire/generated";
import type { Point2 } from "./outline";

/** An outline on the screen while it is drawn, in the world while the tree grows into it. */
export type Outline =
  | { readonly stage: "drawing"; readonly points: readonly Point2[]; readonly repeated: readonly (readonly Point2[])[] }
  | { readonly stage: "growing"; readonly outlines: readonly (readonly Vec3[])[] };

/** Who gets the next outline, in place of the tree that would grow into it. */
export interface OutlineTaker {
  /** The outline lies on a plane through this point. */
  readonly through: Vec3;
  take(outline: Pick<Extract<Command, { kind: "lasso" }>, "outline" | "plane" | "depth">): void;
}

/** The lasso's outline, shown until the tree has filled it. */
export class OutlineTrace {
  taker: OutlineTaker | null = null;
  readonly shown = signal<Outline | null>(null);
  /** The number of the last command that grows it. */
  #command = 0;

  draw(points: readonly Point2[] | null, repeated: readonly (readonly Point2[])[] = []): void {
    this.shown.value = points && { stage: "drawing", points: [...points], repeated };
  }

  /** Outlines are grown by commands up to this one. */
  grow(outlines: readonly (readonly Vec3[])[], command: number): void {
    this.shown.value = { stage: "growing", outlines };
    this.#command = command;
  }

  /** Nothing is left to grow of commands up to this one (`CM11`). */
  done(command: number): void {
    if (this.shown.peek()?.stage === "growing" && command >= this.#command) {
      this.clear();
    }
  }

  clear(): void {
    this.shown.value = null;
  }
}
