import { signal } from "@preact/signals";
import type { TimelineControl } from "../document/timeline/timeline-control";

/** How fast a design is played, to choose from; 1 is the usual pace. */
export const SPEEDS = [0.5, 1, 2, 4, 8] as const;
/** At the usual pace each operation takes so long, in milliseconds, and the whole at least and at most so long. */
const EACH = 900;
const SHORTEST = 6000;
const LONGEST = 90_000;
/** A page that was not drawn for so long, in milliseconds, has not missed a part of the play. */
const LONGEST_FRAME = 100;

/** What the player needs of the line of time. */
export type PlayedTime = Pick<TimelineControl, "timeline" | "scale" | "step" | "pull" | "release" | "to">;

/** Plays a design along its line of time, from the first step to where it stands. */
export class ReplayPlayer {
  readonly playing = signal(false);
  readonly speed = signal<number>(1);
  /** The step where the design stands; null until it is known. */
  #end: number | null = null;
  /** Where on the line it plays, from 0 to 1. */
  #place = 0;
  #before = 0;
  #loop = 0;

  constructor(private readonly time: PlayedTime) {}

  /** The line of time has come: what plays ends where it stands then. */
  stands(): void {
    this.#end ??= this.time.timeline.peek()?.step ?? null;
  }

  /** Where on the line the design stands. */
  get end(): number {
    return this.time.scale.peek().placeOf(this.#end ?? 0);
  }

  /** How long the whole takes at the usual pace, in milliseconds. */
  get length(): number {
    const operations = this.time.timeline.peek()?.operations.length ?? 0;
    return Math.min(LONGEST, Math.max(SHORTEST, EACH * operations));
  }

  toggle(): void {
    if (this.playing.peek()) {
      this.pause();
    } else {
      this.play();
    }
  }

  /** Plays from where the playhead is; at the end, from the beginning. */
  play(): void {
    if (this.playing.peek() || this.#end === null) {
      return;
    }
    const place = this.time.scale.peek().placeOf(this.time.step);
    this.#place = place < this.end ? place : 0;
    this.#before = 0;
    this.playing.value = true;
    this.#loop = requestAnimationFrame(this.#beat);
  }

  /** It stays where it is. */
  pause(): void {
    cancelAnimationFrame(this.#loop);
    if (this.playing.peek()) {
      this.playing.value = false;
      this.time.release();
    }
  }

  /** The next speed, and after the last the first. */
  faster(): void {
    const next = SPEEDS.findIndex((speed) => speed > this.speed.peek());
    this.speed.value = SPEEDS[Math.max(0, next)] ?? 1;
  }

  #beat = (now: number) => {
    const passed = this.#before === 0 ? 0 : Math.min(LONGEST_FRAME, now - this.#before);
    this.#before = now;
    this.#place = Math.min(this.end, this.#place + (passed * this.speed.peek()) / this.length);
    this.time.pull(this.time.scale.peek().stepAt(this.#place));
    if (this.#place >= this.end) {
      this.pause();
      this.time.to(this.#end ?? 0);
      return;
    }
    this.#loop = requestAnimationFrame(this.#beat);
  };
}
