import { effect, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { Air, AirStage } from "../../../scene/motion/air";
import { type AirSettings, blows, sameAir, stilled, stirs } from "../../../scene/motion/air-settings";
import type { Hand } from "../../../scene/motion/hand";
import type { Scale } from "../../../scene/motion/wood";
import { DEFAULT_PARAMETERS, LEAF_NATURES, type LeafKind, type Parameters } from "../../../wire/generated";

/** A wind as the server tells it. */
export interface WindTold {
  readonly settings: AirSettings;
  readonly since: number;
}

/** What the wind needs of the page. */
export interface WindPage {
  /** What all in the session share of it. */
  readonly settings: ReadonlySignal<AirSettings>;
  /** The wind that the server told last, and when that was set, in milliseconds of the time that all share; null before. */
  readonly told: ReadonlySignal<WindTold | null>;
  /** Sets some of it for all: while a control moves, and once it is let go. */
  readonly drag: (patch: Partial<AirSettings>) => void;
  readonly commit: (patch: Partial<AirSettings>) => void;
  readonly parameters: ReadonlySignal<Parameters | null>;
  readonly leaves: () => LeafKind;
  /** What hands on this page are at; those of others calm nothing here. */
  readonly touched: () => Hand | null;
  /** The picture; null where there is none. */
  readonly enliven: (make: (stage: AirStage) => Air) => Air | null;
  /** Makes the wind in the picture. */
  readonly air: (stage: AirStage) => Air;
  /** Whether whoever is here has asked their device for less motion. */
  readonly calmly: boolean;
}

/** Whether trees follow the wind, are held where they are, or stand still because the device is asked for less motion. */
export type WindMode = "moving" | "held" | "still";

/** The wind on this page. What is set is shared by all in the session; to hold it concerns this page alone. */
export class WindControl {
  readonly mode: Signal<WindMode>;
  readonly settings: ReadonlySignal<AirSettings>;
  readonly #page: WindPage;
  readonly #stop: () => void;
  #air: Air | null = null;

  constructor(page: WindPage) {
    this.mode = signal<WindMode>(page.calmly ? "still" : "moving");
    this.#page = page;
    this.settings = page.settings;
    this.#stop = effect(() => {
      const settings = page.settings.value;
      const mode = this.mode.value;
      const { internode_length: internodeLength, leaf_size: leafSize } = page.parameters.value ?? DEFAULT_PARAMETERS;
      const touched = page.touched();
      const leaves = LEAF_NATURES[page.leaves()].flutter;
      // Nothing is loaded or made for a page on which no wind has blown.
      if (this.#air === null && blows(settings)) this.#air = page.enliven(page.air);
      const scale: Scale = { internodeLength, leafSize };
      const told = page.told.value;
      const since = told && sameAir(told.settings, settings) ? told.since / 1000 : null;
      this.#air?.set(mode === "still" ? stilled(settings) : settings, scale, leaves, since);
      this.#air?.touch(touched);
      this.#air?.hold(mode === "held");
    });
  }

  /** Has all made that wind takes, because somebody is about to set one: it is seen at once then. */
  getReady(): void {
    this.#air ??= this.#page.enliven(this.#page.air);
    const { internode_length: internodeLength, leaf_size: leafSize } =
      this.#page.parameters.peek() ?? DEFAULT_PARAMETERS;
    this.#air?.warm({ internodeLength, leafSize });
  }

  /** Sets some of the numbers, while a control still moves. */
  drag(patch: Partial<AirSettings>): void {
    this.#page.drag(patch);
  }

  /** Sets some of the numbers. */
  set(patch: Partial<AirSettings>): void {
    this.#page.commit(patch);
  }

  /** Whether there is something to hold or to let go; where nothing moves for less motion that can be undone in a calm too. */
  get toggles(): boolean {
    return this.mode.value === "still" || stirs(this.settings.value);
  }

  /** Holds what moves, or lets it go. */
  toggle(): void {
    this.mode.value = this.mode.peek() === "moving" ? "held" : "moving";
  }

  dispose(): void {
    this.#stop();
  }
}
