import type { StrokeSample } from "../../../wire/generated";

/** Places closer than this to the one before say nothing new, in internodes. */
export const MIN_SPACING = 0.1;
/** Changes of radius smaller than this say nothing new, in internodes. */
const MIN_WIDENING = 0.05;

/** Places of a brush on their way to the server: thinned where they crowd, never dropped where they do not. */
export class SampleQueue {
  #waiting: StrokeSample[] = [];
  #kept: StrokeSample | null = null;
  #latest: StrokeSample | null = null;

  /** Where the brush is now. */
  get latest(): StrokeSample | null {
    return this.#latest;
  }

  get length(): number {
    return this.#waiting.length;
  }

  /** The brush is here now. */
  add(sample: StrokeSample): void {
    this.#latest = sample;
    if (this.#kept === null || differs(sample, this.#kept)) {
      this.#keep(sample);
    }
  }

  /** The oldest places, at most `limit`; where the brush rests, the place it rests at. */
  take(limit: number): StrokeSample[] {
    if (this.#waiting.length > 0) {
      return this.#waiting.splice(0, limit);
    }
    return this.#latest ? [this.#latest] : [];
  }

  /** Makes sure that the very last place will be sent. */
  finish(): void {
    const { position } = this.#latest ?? {};
    const kept = this.#kept?.position;
    if (this.#latest && !(position && kept && position.every((value, axis) => value === kept[axis]))) {
      this.#keep(this.#latest);
    }
  }

  #keep(sample: StrokeSample): void {
    this.#kept = sample;
    this.#waiting.push(sample);
  }
}

function differs(a: StrokeSample, b: StrokeSample): boolean {
  const distance = Math.hypot(
    a.position[0] - b.position[0],
    a.position[1] - b.position[1],
    a.position[2] - b.position[2],
  );
  return distance >= MIN_SPACING || Math.abs(a.radius - b.radius) >= MIN_WIDENING;
}
