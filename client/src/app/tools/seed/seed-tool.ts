import { signal } from "@preact/signals";
import type { Vec3 } from "../../../scene/vector";
import type { Command } from "../../../wire/generated";
import type { StrokePoint } from "../../input/gesture-recogniser";
import { type Tool, withinReach } from "../tool";

export interface SeedOptions {
  /** Where the ground is under a pixel; null where there is sky, or ground too far off to aim at. */
  readonly groundAt: (x: number, y: number) => Vec3 | null;
  readonly submit: (command: Command) => void;
  /** The number the next command gets. */
  readonly next: () => number;
  /** The finger lifted where there is no ground. */
  readonly missed: () => void;
}

/** A seed that the server was asked for. */
export interface Planted {
  readonly place: Vec3;
  readonly command: number;
}

/** Seeds that are kept of those asked for. */
const MOST_PLANTED = 40;

/** Plants a seed where the finger lifts. */
export class SeedTool implements Tool {
  /** Where the seed would lie; null for nowhere. */
  readonly coming = signal<Vec3 | null>(null);
  /** What was planted last, there yet or not. */
  readonly planted = signal<readonly Planted[]>([]);
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
    this.#lift();
    if (place) {
      const position = withinReach(place);
      const planted = { place: position, command: this.#options.next() };
      this.planted.value = [...this.planted.peek(), planted].slice(-MOST_PLANTED);
      this.#options.submit({ kind: "plant_seed", position });
    } else {
      this.#options.missed();
    }
  }

  abandon(): void {
    this.#lift();
    this.planted.value = [];
  }

  refused(command: Command): void {
    if (command.kind === "plant_seed") {
      this.planted.value = this.planted.peek().filter(({ place }) => `${place}` !== `${command.position}`);
    }
  }

  hover(x: number, y: number): void {
    this.coming.value = this.#options.groundAt(x, y);
  }

  leave(): void {
    this.coming.value = null;
  }

  #lift(): void {
    this.#active = false;
    this.leave();
  }
}
