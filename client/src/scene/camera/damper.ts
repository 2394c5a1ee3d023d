/** Below this fraction of its range a value has arrived. */
const ARRIVED = 1e-4;

/** A critically damped spring: follows a goal without overshoot, independent of the frame rate. */
export class Damper {
  private velocity = 0;

  /** `halfLife` seconds is about how long half of a distance takes. */
  constructor(private readonly halfLife: number) {}

  /** The value after `seconds` on the way to `goal`; exactly the goal once it is within `range` · 10⁻⁴. */
  step(value: number, goal: number, seconds: number, range: number): number {
    if (value === goal && this.velocity === 0) return goal;
    // A critically damped spring has covered half its way after 1.678 of its time constants.
    const rate = 1.678 / this.halfLife;
    const offset = value - goal;
    const slope = this.velocity + rate * offset;
    const decay = Math.exp(-rate * seconds);
    const next = goal + (offset + slope * seconds) * decay;
    this.velocity = (this.velocity - rate * slope * seconds) * decay;
    if (Math.abs(next - goal) < ARRIVED * range && Math.abs(this.velocity) < ARRIVED * range * rate) {
      this.velocity = 0;
      return goal;
    }
    return next;
  }
}
