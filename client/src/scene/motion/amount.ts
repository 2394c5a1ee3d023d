/** Milliseconds in which wind rises or dies away, and in which a whole tree comes to rest. */
const RISES = 1200;
const RESTS = 250;

/** How much of the wind there is, from 0 to 1: it rises and dies away, and there is none where the whole tree is to rest. */
export class Amount {
  private value = 0;
  private last: number | null = null;
  private towards = 0;

  /** Whether it has not yet come where it goes. */
  get changing(): boolean {
    return this.value !== this.towards;
  }

  /** The amount at a time in milliseconds; what changes it now has done so `late` milliseconds ago. */
  at(now: number, blows: boolean, rests: boolean, late = 0): number {
    const towards = blows && !rests ? 1 : 0;
    const since = this.last === null ? 0 : Math.max(0, now - this.last);
    const gone = towards === this.towards || rests ? since : since + late;
    this.last = now;
    this.towards = towards;
    const most = gone / (rests && blows ? RESTS : RISES);
    const gap = this.towards - this.value;
    this.value = Math.abs(gap) <= most ? this.towards : this.value + Math.sign(gap) * most;
    return this.value * this.value * (3 - 2 * this.value);
  }
}
