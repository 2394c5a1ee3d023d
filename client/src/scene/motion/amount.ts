/** Milliseconds in which wind rises or dies away, and in which a whole tree comes to rest. */
const RISES = 1200;
const RESTS = 250;

/** How much of the wind there is, from 0 to 1: it rises and dies away, and there is none where the whole tree is to rest. */
export class Amount {
  private value = 0;
  private last: number | null = null;
  private towards = 0;
  /** Milliseconds in which it goes all the way. */
  private whole = RISES;

  /** Whether it has not yet come where it goes. */
  get changing(): boolean {
    return this.value !== this.towards;
  }

  /** There is nothing to show it with, and none of it: where wind blows it rises once there is, however long that takes. */
  wait(blows: boolean): void {
    this.value = 0;
    this.last = null;
    this.towards = blows ? 1 : 0;
  }

  /** The amount at a time in milliseconds; what changes it from now on has done so `late` milliseconds ago. */
  at(now: number, blows: boolean, rests: boolean, late = 0): number {
    // Since the last frame, which may be long ago, it has gone where it went then.
    this.go(this.last === null ? 0 : Math.max(0, now - this.last));
    this.last = now;
    const before = this.towards;
    this.towards = blows && !rests ? 1 : 0;
    this.whole = rests && blows ? RESTS : RISES;
    if (this.towards !== before && !rests) this.go(late);
    return this.value * this.value * (3 - 2 * this.value);
  }

  private go(gone: number): void {
    const most = gone / this.whole;
    const gap = this.towards - this.value;
    this.value = Math.abs(gap) <= most ? this.towards : this.value + Math.sign(gap) * most;
  }
}
