import { computed, signal } from "@preact/signals";
import type { Timeline } from "../../../wire/generated";
import { edgeBeside, TimeScale } from "./timeline";
import { PATIENCE, TravelPacer } from "./timeline-pacer";

export interface TimelineControlOptions {
  readonly goTo: (step: number) => void;
  readonly takeFuture: (future: number) => void;
  readonly ready: () => boolean;
  /** `go_to` commands that are not yet answered. */
  readonly unsettled: () => number;
  /** Counts the frames of rows that came in. */
  readonly revision: () => number;
  /** The playhead is taken; lets go of it when what this returns is called. */
  readonly hold: () => () => void;
}

/** The line of time as the server tells it, and the hand that travels along it. */
export class TimelineControl {
  readonly told = signal<Timeline | null>(null);
  /** Where the hand has the playhead; null where it stands at the server's step. */
  readonly wanted = signal<number | null>(null);
  readonly scale = computed(() => new TimeScale(this.told.value ?? { operations: [], done: 0 }));
  #options: TimelineControlOptions;
  #pacer = new TravelPacer();
  #loop = 0;
  #letGo = () => {};
  #held = false;
  #resting = 0;

  constructor(options: TimelineControlOptions) {
    this.#options = options;
  }

  /** Where the playhead is shown. */
  get step(): number {
    return this.wanted.value ?? this.told.value?.step ?? 0;
  }

  receive(timeline: Timeline): void {
    this.told.value = timeline;
    const wanted = this.wanted.peek();
    if (wanted !== null && wanted > timeline.last_step) {
      // Someone has begun another future: the steps pulled at are no longer on this line.
      this.stop();
    }
  }

  /** The hand pulls the playhead to a step, and keeps hold of it. */
  pull(step: number): void {
    this.#held = true;
    this.#travel(step);
  }

  /** The hand lets go; the tree comes to where the playhead was left. */
  release(): void {
    this.#held = false;
  }

  /** Goes so many steps back (below 0) or forth. */
  by(steps: number): void {
    this.#travel((this.wanted.peek() ?? this.told.peek()?.step ?? 0) + steps);
  }

  /** Goes to a step. */
  to(step: number): void {
    this.#travel(step);
  }

  /** Goes to where the operation before began, or the next one ends. */
  toEdge(direction: -1 | 1): void {
    const step = this.wanted.peek() ?? this.told.peek()?.step ?? 0;
    this.#travel(edgeBeside(this.told.peek()?.operations ?? [], step, direction));
  }

  /** Leaves this line of time for another one that branches off it. */
  take(future: number): void {
    this.stop();
    this.#options.takeFuture(future);
  }

  /** Forgets where the playhead was pulled: it stands where the server is. */
  stop(): void {
    if (this.#loop !== 0) {
      cancelAnimationFrame(this.#loop);
      this.#loop = 0;
      this.#letGo();
    }
    this.#held = false;
    this.wanted.value = null;
  }

  clear(): void {
    this.stop();
    this.told.value = null;
  }

  #travel(step: number): void {
    const told = this.told.peek();
    if (!told) {
      return;
    }
    this.wanted.value = Math.min(told.last_step, Math.max(0, Math.round(step)));
    this.#resting = 0;
    if (this.#loop === 0) {
      this.#pacer.take();
      this.#letGo = this.#options.hold();
      this.#loop = requestAnimationFrame(this.#beat);
    }
  }

  #beat = (now: number) => {
    this.#loop = requestAnimationFrame(this.#beat);
    const [wanted, told] = [this.wanted.peek(), this.told.peek()];
    if (wanted === null || !told || !this.#options.ready()) {
      return;
    }
    const state = { unsettled: this.#options.unsettled(), step: told.step, revision: this.#options.revision() };
    const step = this.#pacer.tick(now, wanted, state);
    if (step !== null) {
      this.#options.goTo(step);
      this.#resting = 0;
      return;
    }
    if (this.#held || state.unsettled > 0 || !this.#pacer.followed(wanted, told.step)) {
      return;
    }
    this.#resting ||= now;
    // Where another hand goes on at the same time, the server may never tell of just this step.
    if (told.step === wanted || now - this.#resting > PATIENCE) {
      this.stop();
    }
  };
}
