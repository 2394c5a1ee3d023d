import { effect, type ReadonlySignal, type Signal } from "@preact/signals";
import type { Shell, Shells } from "../../../scene/structure/shells";
import type { Gesture } from "../../input/gesture";
import type { Handle, Readout } from "./branch-handles";
import type { BranchShape } from "./branch-shape";
import type { DesignSignal } from "./design-signal";

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

/** What takes hold of fingers on the picture. */
interface Holding {
  readonly design: DesignSignal;
  /** Shells in the picture; null while there is none. */
  readonly shells: () => Pick<Shells, "show"> | null;
}

/** As long as it is on, gestures on the picture are its own, and the picture shows its shells. Gives what ends that. */
export function holdHands(
  { design, shells }: Holding,
  isOn: ReadonlySignal<boolean>,
  shown: ReadonlySignal<readonly Shell[]>,
  gesture: (gesture: Gesture) => Gesture | null,
): () => void {
  const stops = [
    effect(() => {
      if (!isOn.value) {
        return undefined;
      }
      design.hands = gesture;
      return () => {
        if (design.hands === gesture) {
          design.hands = null;
        }
      };
    }),
    effect(() => {
      const seen = shown.value;
      shells()?.show(seen);
    }),
  ];
  return () => {
    for (const stop of stops) {
      stop();
    }
  };
}
