import { grown } from "./column";

/** How long a radius takes to glide to what it is now, in seconds. */
export const EASE_SECONDS = 0.2;
/** Differences below this share are not seen. */
const UNSEEN = 0.01;

/**
 * Radii that glide: whatever changed them, a person's own width as the server solved it, somebody else's, or a step
 * in time, wood never jumps from one thickness to another.
 */
export class RadiusEase {
  /** When the last radius will be what it is, in the table's seconds. */
  until = Number.NEGATIVE_INFINITY;
  private rows = new Int32Array(64);
  private from = new Float32Array(64);
  private count = 0;
  /** The round in which each row was noted last. */
  private noted = new Uint32Array(64);
  private round = 1;

  /** A row is about to change; it is shown with this radius. What is noted first counts. */
  note(row: number, shown: number): void {
    if (row >= this.noted.length) this.noted = grown(this.noted, 2 ** Math.ceil(Math.log2(row + 1)));
    if (shown <= 0 || this.noted[row] === this.round) return;
    this.noted[row] = this.round;
    if (this.count === this.rows.length) {
      this.rows = grown(this.rows, 2 * this.count);
      this.from = grown(this.from, 2 * this.count);
    }
    this.rows[this.count] = row;
    this.from[this.count] = shown;
    this.count += 1;
  }

  /** All have changed: those that are visibly otherwise now begin to glide. */
  begin(now: number, target: (row: number) => number, ease: (row: number, from: number) => void): void {
    for (let i = 0; i < this.count; i += 1) {
      const [row, from] = [this.rows[i]!, this.from[i]!];
      const to = target(row);
      if (to <= 0 || Math.abs(from / to - 1) < UNSEEN) continue;
      ease(row, from);
      this.until = now + EASE_SECONDS;
    }
    this.count = 0;
    this.round += 1;
  }
}

/** How far something has come after so long; fast at first, as the shaders' own. */
export function eased(since: number, seconds: number): number {
  const t = Math.min(1, Math.max(0, since / seconds));
  return t * (2 - t);
}
