/** Frames that only wind asks for: milliseconds from one to the next at least, and where frames are slow. */
const QUICK = 1000 / 60;
const SLOW = 1000 / 30;
/** What a display is early by. */
const SLACK = 4;
/** Milliseconds between frames that are slow, and that are so slow that the picture is made coarser. */
const LATE = 24;
const HEAVY = 48;
const JUDGED = 8;
/** So much slower than that, that it is known from two of them. */
const VERY_HEAVY = 120;
/** Milliseconds between two shadow maps. */
const SHADOW = 60;

/** How often the wind has a frame drawn. Wind alone makes the picture no coarser unless frames are slow all the same. */
export class Pace {
  private last: number | null = null;
  private least = QUICK;
  private isHeavy = false;
  private recent: number[] = [];
  private shadowed = Number.NEGATIVE_INFINITY;

  /** Whether it is too early for the next frame. */
  early(now: number): boolean {
    return this.last !== null && now - this.last < this.least - SLACK;
  }

  /** A frame is drawn now; says whether they are so slow that the picture has to be coarser, until the wind rests. */
  heavy(now: number): boolean {
    if (this.last !== null && now > this.last) this.recent.push(now - this.last);
    this.last = now;
    const [first = 0, second = 0] = this.recent.slice(-2);
    if (Math.min(first, second) > VERY_HEAVY) this.isHeavy = true;
    if (this.recent.length < JUDGED) return this.isHeavy;
    const middle = [...this.recent].sort((a, b) => a - b)[JUDGED / 2]!;
    this.recent = [];
    if (middle > HEAVY) this.isHeavy = true;
    else if (middle > LATE) this.least = SLOW;
    return this.isHeavy;
  }

  /** Whether a shadow map is due that follows the tree. */
  shadow(now: number): boolean {
    if (now - this.shadowed < SHADOW) return false;
    this.shadowed = now;
    return true;
  }

  /** Nothing moves any more. */
  rest(): void {
    this.last = null;
    this.least = QUICK;
    this.isHeavy = false;
    this.recent = [];
  }
}
