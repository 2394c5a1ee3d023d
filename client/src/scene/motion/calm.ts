import { NONE } from "./limbs";

/** Milliseconds in which a joint comes to rest under a hand, and in which it sways as before once the hand has gone. */
export const RESTS = 250;
export const RETURNS = 1200;

/** How much of its sway each joint shows, from 0 to 1: a function of time that runs smoothly to where it was last aimed. */
export class Calm {
  private readonly from: Float64Array;
  private readonly to: Float64Array;
  private readonly since: Float64Array;

  /** Joints are known by their lowest rows; those that bear stand before those that are borne. All sway. */
  constructor(
    private readonly first: Int32Array = new Int32Array(0),
    private readonly parent: Int32Array = new Int32Array(0),
  ) {
    this.from = new Float64Array(first.length).fill(1);
    this.to = new Float64Array(first.length).fill(1);
    this.since = new Float64Array(first.length).fill(Number.NEGATIVE_INFINITY);
  }

  /** From `now` on each joint that was aimed elsewhere runs to the share that it is given. */
  aim(share: (joint: number) => number, now: number): void {
    for (let joint = 0; joint < this.to.length; joint += 1) {
      const to = share(joint);
      if (to === this.to[joint]) continue;
      this.from[joint] = this.at(joint, now);
      this.to[joint] = to;
      this.since[joint] = now;
    }
  }

  /** Has a joint sway in full at once. */
  free(joint: number): void {
    this.to[joint] = 1;
    this.since[joint] = Number.NEGATIVE_INFINITY;
  }

  /** The share of a joint at a time in milliseconds. */
  at(joint: number, now: number): number {
    const [from, to] = [this.from[joint]!, this.to[joint]!];
    const gone = Math.min(1, Math.max(0, (now - this.since[joint]!) / (to < from ? RESTS : RETURNS)));
    return from + (to - from) * gone * gone * (3 - 2 * gone);
  }

  /** Whether any joint shows less than all of its sway at a time, and whether any is still on its way. */
  look(now: number): { readonly calms: boolean; readonly changes: boolean } {
    let [calms, changes] = [false, false];
    for (let joint = 0; joint < this.to.length; joint += 1) {
      const onWay = now < this.since[joint]! + (this.to[joint]! < this.from[joint]! ? RESTS : RETURNS);
      changes ||= onWay;
      calms ||= onWay || this.to[joint] !== 1;
    }
    return { calms, changes };
  }

  /** The same for other joints: those that there were go on, and new ones do as what bears them. */
  carried(first: Int32Array, parent: Int32Array): Calm {
    const next = new Calm(first, parent);
    const known = new Map(Array.from(this.first, (row, joint) => [row, joint] as const));
    for (const [joint, row] of first.entries()) {
      const before = known.get(row);
      const [source, of] = before === undefined ? [next, next.parent[joint]!] : [this, before];
      if (of === NONE) continue;
      next.from[joint] = source.from[of]!;
      next.to[joint] = source.to[of]!;
      next.since[joint] = source.since[of]!;
    }
    return next;
  }
}
