import { grown } from "./column";
import { EASE_SECONDS, eased } from "./radius-ease";

/** More rows than this would be felt in each frame; then all are at once where they belong. */
const MOST = 4000;
/** Nearer than this, in internodes, is not seen. */
const UNSEEN = 0.003;

/**
 * Places that glide: where wood is drawn follows from its girth, so that it shifts a little when that changes, though no
 * node has moved.
 */
export class PlaceEase {
  /** When the last will be where it is, in the table's seconds. */
  until = Number.NEGATIVE_INFINITY;
  private gliding = new Places();
  private noted = new Places();
  private began = 0;

  /** A row is about to be drawn elsewhere; the first number of its place as it is shown is here. */
  note(row: number, shown: Float32Array, at: number): void {
    if (this.noted.rows.length <= MOST) this.noted.add(row, shown[at]!, shown[at + 1]!, shown[at + 2]!);
  }

  /** All have changed: those that are visibly elsewhere begin to glide, and those still on their way go on from there. */
  begin(now: number, placed: Float32Array): void {
    const { noted, gliding } = this;
    if (noted.rows.length === 0) return;
    if (gliding.rows.length > 0) {
      const again = new Set(noted.rows);
      const left = this.leftAt(now);
      const { from } = gliding;
      for (const [i, row] of gliding.rows.entries()) {
        if (again.has(row)) continue;
        const [x, y, z] = [0, 1, 2].map((axis) => {
          const own = placed[3 * row + axis]!;
          return own + left * (from[3 * i + axis]! - own);
        }) as [number, number, number];
        noted.add(row, x, y, z);
      }
    }
    gliding.rows.length = 0;
    const count = noted.rows.length > MOST ? 0 : noted.rows.length;
    for (let i = 0; i < count; i += 1) {
      const row = noted.rows[i]!;
      const [x, y, z] = [noted.from[3 * i]!, noted.from[3 * i + 1]!, noted.from[3 * i + 2]!];
      const [dx, dy, dz] = [x - placed[3 * row]!, y - placed[3 * row + 1]!, z - placed[3 * row + 2]!];
      if (Math.max(Math.abs(dx), Math.abs(dy), Math.abs(dz)) >= UNSEEN) gliding.add(row, x, y, z);
    }
    noted.rows.length = 0;
    this.began = now;
    if (gliding.rows.length > 0) this.until = now + EASE_SECONDS;
  }

  /** Tells of each row below `end` how much is left of its way from where it was, which begins there in a list. */
  step(now: number, end: number, glide: (row: number, from: Float32Array, at: number, left: number) => void): void {
    const { rows, from } = this.gliding;
    if (rows.length === 0) return;
    const left = this.leftAt(now);
    for (const [i, row] of rows.entries()) if (row < end) glide(row, from, 3 * i, left);
    if (left === 0) rows.length = 0;
  }

  private leftAt(now: number): number {
    return 1 - eased(now - this.began, EASE_SECONDS);
  }
}

/** Rows with a place each. */
class Places {
  readonly rows: number[] = [];
  from = new Float32Array(0);

  add(row: number, x: number, y: number, z: number): void {
    const at = 3 * this.rows.length;
    if (at + 3 > this.from.length) this.from = grown(this.from, 2 * at + 96);
    this.from[at] = x;
    this.from[at + 1] = y;
    this.from[at + 2] = z;
    this.rows.push(row);
  }
}
