import type { Box } from "../../../scene/camera/camera-view";

/** A plant that has become so many times larger or smaller is shown whole again. */
const OUTGROWN = 1.1;

/** The parts of a page that show a plant. */
export interface Framed {
  readonly stage: {
    fitTree(): void;
    /** The camera counts how often somebody has moved it. */
    readonly view: { readonly camera: { readonly moves: number } } | null;
  };
  readonly table: { bounds(): Box };
  readonly settings: { readonly followsGrowth: { peek(): boolean } };
}

/**
 * Shows a plant whole when another one is planted, and again when its text or depth makes it much larger or smaller, until
 * somebody moves the view.
 */
export class Framing {
  readonly #page: Framed;
  /** How large the plant was that is shown whole, and how often the camera had been moved by then. */
  #shown: { readonly size: number; readonly moves: number } | null = null;
  /** What came over the plant since it was looked at last. */
  #since: "nothing" | "change" | "planting" = "nothing";

  constructor(page: Framed) {
    this.#page = page;
  }

  /** Another plant is on its way. */
  planted(): void {
    this.#since = "planting";
  }

  /** The plant that stands is being made anew, or further. */
  changed(): void {
    if (this.#since === "nothing") {
      this.#since = "change";
    }
  }

  /** What was asked for stands. */
  settled(): void {
    const since = this.#since;
    if (since === "nothing") {
      return;
    }
    this.#since = "nothing";
    const { stage, table, settings } = this.#page;
    const size = sizeOf(table.bounds());
    const shown = this.#shown;
    const isOutgrown = shown !== null && (size > OUTGROWN * shown.size || size * OUTGROWN < shown.size);
    const isFree = shown !== null && stage.view?.camera.moves === shown.moves && settings.followsGrowth.peek();
    if (since === "planting" || (isOutgrown && isFree)) {
      stage.fitTree();
      this.#shown = { size, moves: stage.view?.camera.moves ?? 0 };
    }
  }
}

function sizeOf({ min, max }: Box): number {
  return Math.max(max[0] - min[0], max[1] - Math.min(0, min[1]), max[2] - min[2]);
}
