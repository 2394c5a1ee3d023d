/** Shadows are drawn anew once so many more or fewer of the leaves are drawn as sprigs. */
const MERGED_STEP = 0.125;

/** Decides when the shadow map is drawn again: after a change of what casts shadows, but not more often than the quality allows. */
export class ShadowDue {
  /** Whether the map is out of date. */
  stale = true;
  #drawnAt = Number.NEGATIVE_INFINITY;
  /** How far leaves had given way to sprigs then. */
  #merged = 0;

  /**
   * Whether it is to be drawn at a time, in milliseconds, and then counts as drawn. `merged` says how far leaves have
   * given way to sprigs, or is null where they do so in haste only; `every` how many milliseconds lie between two maps at least.
   */
  take(now: number, every: number, growing: boolean, merged: number | null): boolean {
    // Shadows are those of the leaves that are drawn, near enough.
    this.stale ||= growing || Math.abs((merged ?? this.#merged) - this.#merged) > MERGED_STEP;
    if (!this.stale || now - this.#drawnAt < every) return false;
    this.#drawnAt = now;
    this.#merged = merged ?? this.#merged;
    // One more frame after the last growth shows everything full grown.
    this.stale = growing;
    return true;
  }
}
