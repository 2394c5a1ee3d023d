import type { ReadonlySignal, Signal } from "@preact/signals";
import type { Handle, Readout } from "./branch-handles";
import type { BranchShape } from "./branch-shape";

/** How many handles cannot be hit: because they lie too close together, or because one looks along them. */
export interface Hidden {
  readonly near: number;
  readonly along: number;
}

/** What a finger makes of a shape, while it does. */
export interface HeldShape {
  readonly handle: string;
  readonly shape: BranchShape;
  readonly readout: Readout;
}

/** Something in the picture whose handles fingers move. */
export interface HandsOn {
  /** As it is to be drawn. */
  readonly chosen: ReadonlySignal<BranchShape | null>;
  readonly handles: ReadonlySignal<readonly Handle[]>;
  readonly held: ReadonlySignal<HeldShape | null>;
  /** Handles that are not shown. */
  readonly hidden: Signal<Hidden>;
  /** Whether a finger on the picture draws, what it has drawn, and what that is to become. */
  readonly sketching: ReadonlySignal<boolean>;
  readonly trace: ReadonlySignal<readonly (readonly [number, number])[]>;
  readonly draws: ReadonlySignal<"axis" | "outline">;
  grip(handle: Handle): void;
  drag(x: number, y: number): void;
  release(): void;
  cancel(): boolean;
  /** What a double tap on a handle does. */
  without(handle: Handle): void;
}
