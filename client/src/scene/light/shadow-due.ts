/** Shadows are drawn anew once so many more or fewer of the leaves are drawn as sprigs. */
const MERGED_STEP = 0.125;

/** Decides when the shadow map is drawn again: after a change of what casts shadows, but not more often than the quality allows. */
export class ShadowDue {
  /** Whether the map is out of date. */
  stale = true;
  #drawnAt = Number.NEGATIVE_INFINITY;
  /** How far leaves had given way to sprigs then. */
  #merged = 0;
  /** The share of its texels with which it was drawn. */
  #share = 1;

  /** Whether it is out of date, or coarser than at rest. */
  get isDue(): boolean {
    return this.stale || this.#share < 1;
  }

  /**
   * Whether it is to be drawn at a time, in milliseconds, and then counts as drawn. `merged` says how far leaves have
   * given way to sprigs, or is null where they do so in haste only; `every` how many milliseconds lie between two maps at
   * least; `share` how many of its texels along each side it is drawn with.
   */
  take(now: number, every: number, growing: boolean, merged: number | null, share = 1): boolean {
    // Shadows are those of the leaves that are drawn, near enough. A finer map than needed stays as it is.
    this.stale ||= growing || share > this.#share;
    this.stale ||= Math.abs((merged ?? this.#merged) - this.#merged) > MERGED_STEP;
    if (!this.stale || now - this.#drawnAt < every) return false;
    this.#drawnAt = now;
    this.#share = share;
    this.#merged = merged ?? this.#merged;
    // One more frame after the last growth shows everything full grown.
    this.stale = growing;
    return true;
  }
}
