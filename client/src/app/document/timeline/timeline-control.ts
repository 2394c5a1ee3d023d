import { computed, signal } from "@preact/signals";
import type { Timeline, TimelineChange } from "../../../wire/generated";
import { changed, edgeBeside, NOTHING_DONE, TimeScale } from "./timeline";
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

/** The timeline as the server has it, and the playhead that the user moves along it. */
export class TimelineControl {
  readonly timeline = signal<Timeline | null>(null);
  /** Where the user holds the playhead; null where it stands at the server's step. */
  readonly wanted = signal<number | null>(null);
  readonly scale = computed(() => new TimeScale(this.timeline.value ?? { operations: [], done: 0 }));
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
    return this.wanted.value ?? this.timeline.value?.step ?? 0;
  }

  receive(timeline: Timeline): void {
    this.timeline.value = timeline;
    const wanted = this.wanted.peek();
    if (wanted !== null && wanted > timeline.last_step) {
      // Someone has begun another future: the steps pulled at are no longer on this line.
      this.stop();
    }
  }

  /** Takes in what changed since the timeline was told last (`TT6`); gives it as it is now. */
  change(change: TimelineChange): Timeline {
    const timeline = changed(this.timeline.peek() ?? NOTHING_DONE, change);
    this.receive(timeline);
    return timeline;
  }

  /** The user drags the playhead to a step, and keeps hold of it. */
  pull(step: number): void {
    this.#held = true;
    this.#travel(step);
  }

  /** The user lets go; the tree comes to the step at which the playhead was left. */
  release(): void {
    this.#held = false;
  }

  /** Goes so many steps back (below 0) or forth. */
  by(steps: number): void {
    this.#travel((this.wanted.peek() ?? this.timeline.peek()?.step ?? 0) + steps);
  }

  /** Goes to a step. */
  to(step: number): void {
    this.#travel(step);
  }

  /** Goes to where the operation before began, or the next one ends. */
  toEdge(direction: -1 | 1): void {
    const step = this.wanted.peek() ?? this.timeline.peek()?.step ?? 0;
    this.#travel(edgeBeside(this.timeline.peek()?.operations ?? [], step, direction));
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
    this.timeline.value = null;
  }

  #travel(step: number): void {
    const timeline = this.timeline.peek();
    if (!timeline) {
      return;
    }
    this.wanted.value = Math.min(timeline.last_step, Math.max(0, Math.round(step)));
    this.#resting = 0;
    if (this.#loop === 0) {
      this.#pacer.take();
      this.#letGo = this.#options.hold();
      this.#loop = requestAnimationFrame(this.#beat);
    }
  }

  #beat = (now: number) => {
    this.#loop = requestAnimationFrame(this.#beat);
    const [wanted, timeline] = [this.wanted.peek(), this.timeline.peek()];
    if (wanted === null || !timeline || !this.#options.ready()) {
      return;
    }
    const state = { unsettled: this.#options.unsettled(), step: timeline.step, revision: this.#options.revision() };
    const step = this.#pacer.tick(now, wanted, state);
    if (step !== null) {
      this.#options.goTo(step);
      this.#resting = 0;
      return;
    }
    if (this.#held || state.unsettled > 0 || !this.#pacer.followed(wanted, timeline.step)) {
      return;
    }
    this.#resting ||= now;
    // Where another user travels at the same time, the server may never report this very step.
    if (timeline.step === wanted || now - this.#resting > PATIENCE) {
      this.stop();
    }
  };
}
