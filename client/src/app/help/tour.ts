import { computed, effect, signal } from "@preact/signals";
import type { Settings } from "../page/settings";

/** The gestures the tour shows, in their order. */
export const TOUR_STEPS = ["draw", "turn", "grow"] as const;
export type TourStep = (typeof TOUR_STEPS)[number];

/** How long the tour waits after a gesture was done, in milliseconds. */
const SAVOURED = 1200;

export interface TourOptions {
  readonly settings: Settings;
  /** Whether the workspace can be used. */
  readonly ready: () => boolean;
  /** How much has been drawn, in whatever measure grows with it. */
  readonly drawn: () => number;
  /** How far the tree is turned, in radians; read as often as `look` is called. */
  readonly turned: () => number;
  /** Whether the lever that grows is held. */
  readonly growing: () => boolean;
}

/** A first run in three gestures: each is shown until the user has done it. */
export class Tour {
  readonly #at = signal<number | null>(null);
  /** Whether the gesture shown has been done. */
  readonly done = signal(false);
  /** The gesture shown now; null where there is no tour. */
  readonly step = computed<TourStep | null>(() =>
    this.#at.value === null ? null : (TOUR_STEPS[this.#at.value] ?? null),
  );
  #options: TourOptions;
  #drawnBefore = 0;
  #turnedBefore = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(options: TourOptions) {
    this.#options = options;
  }

  /** Offers itself where it has not been seen, and watches what the user does; returns what ends that. */
  follow(): () => void {
    const stopOffering = effect(() => {
      if (!this.#options.settings.tourSeen.value && this.#options.ready() && this.#at.peek() === null) {
        this.start();
      }
    });
    const stopWatching = effect(() => {
      const step = this.step.value;
      const drawn = this.#options.drawn();
      const growing = this.#options.growing();
      if ((step === "draw" && drawn > this.#drawnBefore) || (step === "grow" && growing)) {
        this.#accomplish();
      }
    });
    return () => {
      stopOffering();
      stopWatching();
      clearTimeout(this.#timer);
    };
  }

  start(): void {
    this.#go(0);
  }

  /** On to the next gesture; after the last the tour is over. */
  next(): void {
    const at = this.#at.peek();
    if (at !== null) {
      this.#go(at + 1);
    }
  }

  skip(): void {
    this.#go(TOUR_STEPS.length);
  }

  /** The view may have been turned. */
  look(): void {
    if (this.step.peek() === "turn" && Math.abs(Math.sin((this.#options.turned() - this.#turnedBefore) / 2)) > 0.2) {
      this.#accomplish();
    }
  }

  #go(at: number): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.done.value = false;
    this.#drawnBefore = this.#options.drawn();
    this.#turnedBefore = this.#options.turned();
    this.#at.value = at < TOUR_STEPS.length ? at : null;
    if (at >= TOUR_STEPS.length) {
      this.#options.settings.tourSeen.value = true;
    }
  }

  #accomplish(): void {
    if (!this.done.peek()) {
      this.done.value = true;
      this.#timer = setTimeout(() => this.next(), SAVOURED);
    }
  }
}
