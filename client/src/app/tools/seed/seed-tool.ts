import { signal } from "@preact/signals";
import type { Vec3 } from "../../../scene/vector";
import type { Command } from "../../../wire/generated";
import type { StrokePoint } from "../../input/gesture-recogniser";
import { type Tool, withinReach } from "../tool";

export interface SeedOptions {
  /** Where the ground is under a pixel; null where there is sky, or ground too far off to aim at. */
  readonly groundAt: (x: number, y: number) => Vec3 | null;
  readonly submit: (command: Command) => void;
  /** The finger lifted where there is no ground. */
  readonly missed: () => void;
}

/** Plants a seed where the finger lifts. */
export class SeedTool implements Tool {
  /** Where the seed would lie; null for nowhere. */
  readonly coming = signal<Vec3 | null>(null);
  #options: SeedOptions;
  #active = false;

  constructor(options: SeedOptions) {
    this.#options = options;
  }

  begin(point: StrokePoint): void {
    this.#active = true;
    this.move([point]);
  }

  move(points: readonly StrokePoint[]): void {
    const last = points[points.length - 1];
    if (this.#active && last) {
      this.hover(last.x, last.y);
    }
  }

  end(): void {
    if (!this.#active) {
      return;
    }
    const place = this.coming.peek();
    this.abandon();
    if (place) {
      this.#options.submit({ kind: "plant_seed", position: withinReach(place) });
    } else {
      this.#options.missed();
    }
  }

  abandon(): void {
    this.#active = false;
    this.leave();
  }

  hover(x: number, y: number): void {
    this.coming.value = this.#options.groundAt(x, y);
  }

  leave(): void {
    this.coming.value = null;
  }
}
