/** Share of the radius that the lightest touch of a pen gives. */
const LIGHTEST = 0.2;
/** And the firmest. */
const FIRMEST = 1.8;
/** How far the felt pressure goes towards a new sample's. */
const FOLLOW = 0.35;

/** Share of the chosen radius for a pen's pressure from 0 to 1: half pressure is the radius as it was chosen. */
export function radiusShare(pressure: number): number {
  const p = Math.min(1, Math.max(0, pressure));
  // Flat at both ends: a hand can neither rest nor press without trembling.
  return LIGHTEST + (FIRMEST - LIGHTEST) * p * p * (3 - 2 * p);
}

/** A pen's pressure over a stroke, without its jitter. */
export class FeltPressure {
  #felt: number | null = null;

  /** Takes the next sample; null where the device measures no pressure. */
  follow(pressure: number | null): number | null {
    this.#felt = pressure === null || this.#felt === null ? pressure : this.#felt + FOLLOW * (pressure - this.#felt);
    return this.#felt;
  }

  get value(): number | null {
    return this.#felt;
  }
}
