/** How far a finger may wander before it is drawing, in pixels. */
export const SLOP = 9;
/** Longer than this, in milliseconds from the first finger down to the last one up, several fingers are no tap. */
export const LONGEST_TAP_OF_SEVERAL = 320;

interface Finger {
  x: number;
  y: number;
  /** Where it came down. */
  readonly from: { readonly x: number; readonly y: number };
}

/** The centre of some fingers, and how far they are from it on average, times two. */
export interface Spread {
  readonly x: number;
  readonly y: number;
  readonly distance: number;
}

/** The touches that are down and count, and whether they may be a tap of several. */
export class Fingers {
  #down = new Map<number, Finger>();
  /** Since when fingers are down, and the most at once; null once they can no longer be a tap. */
  #tap: { readonly since: number; most: number } | null = null;
  /** The spread that `moved` returned last. */
  #returned: Spread = { x: 0, y: 0, distance: 0 };

  get size(): number {
    return this.#down.size;
  }

  has(id: number): boolean {
    return this.#down.has(id);
  }

  add(id: number, x: number, y: number, time: number): void {
    if (this.size === 0) {
      this.#tap = { since: time, most: 0 };
    }
    this.#down.set(id, { x, y, from: { x, y } });
    if (this.#tap) {
      this.#tap.most = Math.max(this.#tap.most, this.size);
    }
    this.#returned = this.#spread();
  }

  /** Notes where a finger is now. */
  place(id: number, x: number, y: number): void {
    const finger = this.#down.get(id);
    if (finger) {
      finger.x = x;
      finger.y = y;
      if (Math.hypot(x - finger.from.x, y - finger.from.y) > SLOP) {
        this.#tap = null;
      }
    }
  }

  /** The same, and how they all have moved since the last call; null while they may still be a tap. */
  moved(id: number, x: number, y: number, time: number): readonly [before: Spread, after: Spread] | null {
    this.place(id, x, y);
    if (this.#tap && time - this.#tap.since <= LONGEST_TAP_OF_SEVERAL) {
      return null;
    }
    this.#tap = null;
    const before = this.#returned;
    this.#returned = this.#spread();
    return [before, this.#returned];
  }

  /** A finger is gone; `time` is null where the system took it away. Gives the tap that is over with it, in fingers. */
  remove(id: number, time: number | null): number {
    if (!this.#down.delete(id)) {
      return 0;
    }
    this.#returned = this.#spread();
    const tap = this.#tap;
    if (tap === null || time === null || time - tap.since > LONGEST_TAP_OF_SEVERAL) {
      this.#tap = null;
      return 0;
    }
    return this.size === 0 ? tap.most : 0;
  }

  /** What they do is no tap. */
  noTap(): void {
    this.#tap = null;
  }

  clear(): void {
    this.#down.clear();
    this.noTap();
  }

  #spread(): Spread {
    const all = [...this.#down.values()];
    const count = Math.max(1, all.length);
    const x = all.reduce((sum, finger) => sum + finger.x, 0) / count;
    const y = all.reduce((sum, finger) => sum + finger.y, 0) / count;
    const distance = (2 * all.reduce((sum, finger) => sum + Math.hypot(finger.x - x, finger.y - y), 0)) / count;
    return { x, y, distance };
  }
}
