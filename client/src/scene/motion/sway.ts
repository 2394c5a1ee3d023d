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

/** How joints stand, as a function of time: the wind of now, winds of before that fade, and plucks. */
export class Sway {
  /** Answers to winds one after another, and when each took the place of the one before. */
  private readonly winds: { since: number; answers: Answers }[];
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
    const before = this.winds.filter(({ since }) => since < at);
    // A clock that was put back leaves the one that has blown longest.
    this.winds.splice(0, this.winds.length, ...(before.length > 0 ? before : this.winds.slice(0, 1)), {
      since: at,
      answers,
    });
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
    const over = this.winds.findLastIndex(({ since }) => time >= since + FADE);
    if (over > 0) this.winds.splice(0, over);
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
    for (const { since, answers } of this.winds) {
      const share = Math.min(Math.max((time - since) / FADE, 0), 1);
      // A wind that is still to come.
      if (share === 0) continue;
      if (share === 1) {
        answers.bends(time, out);
        continue;
      }
      answers.bends(time, newer);
      const smooth = share * share * (3 - 2 * share);
      for (let i = 0; i < newer.length; i += 1) out[i]! += smooth * (newer[i]! - out[i]!);
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
