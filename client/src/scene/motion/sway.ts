import type { Vec3 } from "../vector";
import type { Answers } from "./answers";

/** Seconds in which one wind takes another's place. */
export const FADE = 1.5;
/** The most plucks that are remembered. */
const MOST_PLUCKS = 32;
/** A pluck of a smaller rotation than this is over, radians. */
const STILL = 1e-3;
/** From this rotation on joints give way less, and none goes further than both together, radians. */
const FREE = 0.8;
const BEYOND = 0.3;

/** A joint that was let go, out of its place. */
export interface Pluck {
  readonly joint: number;
  /** When it was let go, in seconds. */
  readonly at: number;
  /** How far out of its place it was, as a rotation vector. */
  readonly bend: Vec3;
  /** How fast it moved then, radians a second along each axis; not at all where that is left out. */
  readonly speed?: Vec3;
}

const STOOD: Vec3 = [0, 0, 0];

/** What took the place of what was before it, and when. */
export interface Follower {
  readonly since: number;
}

/** How much of what followed at a time is there so many seconds later, from 0 to 1. */
export function fadedIn(gone: number): number {
  const share = Math.min(Math.max(gone / FADE, 0), 1);
  return share * share * (3 - 2 * share);
}

/** What follows one upon another, with a next one. A clock that was put back leaves the one that has been there longest. */
export function followedBy<One extends Follower>(all: readonly One[], next: One): One[] {
  const before = all.filter(({ since }) => since < next.since);
  return [...(before.length > 0 ? before : all.slice(0, 1)), next];
}

/** What is left of what follows one upon another at a time: the last that is there in full, and what came after it. */
export function leftAt<One extends Follower>(all: readonly One[], time: number): readonly One[] {
  return all.slice(
    Math.max(
      0,
      all.findLastIndex(({ since }) => time >= since + FADE),
    ),
  );
}

/** How joints stand, as a function of time: the wind of now, winds of before that fade, and plucks. */
export class Sway {
  /** Answers to winds one after another, and when each took the place of the one before. */
  private winds: readonly { since: number; readonly answers: Answers }[];
  private readonly plucks: Pluck[] = [];
  private newer: Float64Array;

  /** One wind that has always blown. */
  constructor(answers: Answers) {
    this.winds = [{ since: Number.NEGATIVE_INFINITY, answers }];
    this.newer = new Float64Array(3 * answers.count);
  }

  /** From `at` on another wind blows, which takes over within a second and a half. The joints stay what they are. */
  change(answers: Answers, at: number): void {
    if (answers.count !== this.present.count) throw new Error("A wind is changed for the same joints.");
    this.winds = followedBy(this.winds, { since: at, answers });
  }

  /** The last wind took the place of the one before at another time. */
  retime(at: number): void {
    const [before, last] = this.winds.slice(-2);
    if (last && at > before!.since) last.since = at;
  }

  /** A joint is let go. Of more than 32 plucks the oldest are forgotten. */
  pluck(pluck: Pluck): void {
    if (this.plucks.length === MOST_PLUCKS) this.plucks.shift();
    this.plucks.push(pluck);
  }

  /** Forgets what is over at a time. */
  forget(time: number): void {
    this.winds = leftAt(this.winds, time);
    const { damping, rate } = this.present;
    for (let i = this.plucks.length - 1; i >= 0; i -= 1) {
      const { joint, at, bend, speed = STOOD } = this.plucks[i]!;
      const size = Math.hypot(...bend) + Math.hypot(...speed) / rate[joint]!;
      if (size * Math.exp(-damping[joint]! * rate[joint]! * (time - at)) < STILL) this.plucks.splice(i, 1);
    }
  }

  /** The plucks that are not over. */
  get plucked(): readonly Pluck[] {
    return this.plucks;
  }

  /** How fast a joint swings by itself, in s⁻¹, undamped. */
  rateOf(joint: number): number {
    return this.present.rate[joint]!;
  }

  /** Whether something is still on its way at a time, however even the wind: another wind, or a pluck. */
  changing(time: number): boolean {
    return this.plucks.length > 0 || time < this.winds.at(-1)!.since + FADE;
  }

  /** The rotations of all joints at a time in seconds, radians. */
  bends(time: number, out: Float64Array): void {
    const { newer } = this;
    for (const [at, { since, answers }] of this.winds.entries()) {
      // Where a clock was put back there is nothing before the first.
      const share = at === 0 ? 1 : fadedIn(time - since);
      // A wind that is still to come.
      if (share === 0) continue;
      if (share === 1) {
        answers.bends(time, out);
        continue;
      }
      answers.bends(time, newer);
      for (let i = 0; i < newer.length; i += 1) out[i]! += share * (newer[i]! - out[i]!);
    }
    for (const pluck of this.plucks) this.addPluck(pluck, time, out);
    for (let joint = 0; joint < this.present.count; joint += 1) limit(out, 3 * joint);
  }

  private get present(): Answers {
    return this.winds.at(-1)!.answers;
  }

  private addPluck({ joint, at, bend, speed = STOOD }: Pluck, time: number, out: Float64Array): void {
    const gone = time - at;
    if (gone < 0) return;
    const [rate, damping] = [this.present.rate[joint]!, this.present.damping[joint]!];
    const damped = rate * Math.sqrt(1 - damping * damping);
    const [left, sine] = [Math.exp(-damping * rate * gone), Math.sin(damped * gone) / damped];
    const swing = Math.cos(damped * gone) + damping * rate * sine;
    for (let a = 0; a < 3; a += 1) out[3 * joint + a]! += left * (bend[a]! * swing + speed[a]! * sine);
  }
}

/** A rotation that goes too far, smoothly held back. */
function limit(bends: Float64Array, at: number): void {
  const size = Math.hypot(bends[at]!, bends[at + 1]!, bends[at + 2]!);
  if (!(size > FREE)) return;
  const share = (FREE + BEYOND * Math.tanh((size - FREE) / BEYOND)) / size;
  for (let a = at; a < at + 3; a += 1) bends[a]! *= share;
}
