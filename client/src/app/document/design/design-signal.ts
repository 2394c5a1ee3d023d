import { signal } from "@preact/signals";
import { type Dyed, UNDYED } from "../../../scene/table/row-dyes";
import type { DesignInForce, LimbOutline, PlacedBranch } from "../../../wire/generated";
import type { Gesture } from "../../input/gesture";

/** Where branches stand around the one that this page looks at. */
export interface PlacedAround {
  readonly of: string;
  readonly branches: readonly PlacedBranch[];
}

/** A limb that grew, as the server told it to this page (`DS13`). */
export interface ToldLimb {
  /** The row that was asked for. */
  readonly of: number;
  /** None where no limb lives there, or it follows a design. */
  readonly limb: LimbOutline | null;
}

/** The design in force, as the server told it last (`DS4`, `DS8`). */
export class DesignSignal {
  readonly inForce = signal<DesignInForce | null>(null);
  readonly placed = signal<PlacedAround>({ of: "", branches: [] });
  readonly limb = signal<ToldLimb | null>(null);
  /** The colours that branches have of their own (`DS14`). */
  readonly dyed = signal<Dyed>(UNDYED);
  /** What takes gestures on the canvas while a design is shaped by hand, and gives what is left of them. */
  hands: ((gesture: Gesture) => Gesture | null) | null = null;

  receive(design: DesignInForce | null): void {
    this.inForce.value = design;
  }
}
