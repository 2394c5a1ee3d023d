import { signal } from "@preact/signals";
import type { DesignInForce } from "../../../wire/generated";

/** The design in force, as the server told it last (`DS4`). */
export class DesignSignal {
  readonly inForce = signal<DesignInForce | null>(null);

  receive(design: DesignInForce | null): void {
    this.inForce.value = design;
  }
}
