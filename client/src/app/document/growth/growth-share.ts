/** Growth of fewer steps shows no progress bar: it would fill at once. */
const WORTH_A_BAR = 8;

/** The finished share of growth, from the steps that are left and the most that were left since it began. */
export class GrowthShare {
  #most = 0;

  /** The share from 0 to 1 with so many steps left; null where there is nothing to measure. */
  of(left: number): number | null {
    this.#most = left === 0 ? 0 : Math.max(this.#most, left);
    return this.#most < WORTH_A_BAR ? null : 1 - left / this.#most;
  }
}
