import { FrameError } from "./frame-error";
import { LETTERS, LEVELS, MOST_SEEN, PRIORS, SEEN_BEFORE } from "./generated-models";
import type { FieldNumber, NumberSource } from "./numbers";

/** Parts of which a probability counts how many. */
const WHOLE = 1 << 12;
const LEAST_RANGE = 1 << 24;
/** So many bytes of zeros may be left out at the end. */
const FLUSHED_BYTES = 4;
/** Contexts for the length of a number; longer ones share the last. */
const LENGTHS = 16;

/** How a frame begins: where the contexts of each field begin, how likely a bit is 0 in 65,536 cases, what that counts. */
const usual = (() => {
  const starts: number[] = [];
  const zeros: number[] = [];
  const seen: number[] = [];
  for (const line of PRIORS.trimEnd().split("\n")) {
    starts.push(zeros.length);
    for (const letter of line) {
      const level = LETTERS.indexOf(letter) - (LEVELS.length - 1);
      const isSeen = letter !== ".";
      zeros.push(!isSeen ? LEVELS[0]! : level < 0 ? 65_536 - LEVELS[-level]! : LEVELS[level]!);
      seen.push(isSeen ? SEEN_BEFORE : 0);
    }
  }
  return { starts, zeros: Uint16Array.from(zeros), seen: Uint8Array.from(seen) };
})();

/** Reads what models and a range coder have packed (FR9); mirrors `proto/src/packing.rs`. */
export class Unpacker implements NumberSource {
  readonly #zeros = usual.zeros.slice();
  readonly #seen = usual.seen.slice();
  #code = 0;
  #range = 0xffffffff;
  #read = 0;

  constructor(private readonly bytes: Uint8Array) {
    for (let i = 0; i < FLUSHED_BYTES; i += 1) this.#shift();
  }

  number(field: FieldNumber): number {
    const base = usual.starts[field]!;
    let length = 0;
    while (this.#bit(base + Math.min(length, LENGTHS - 1))) {
      length += 1;
      if (length > 32) throw new FrameError("A number in the frame has more than 32 bits.");
    }
    // Two bits below the highest have contexts of their own; multiplied, not shifted, for there may be 33 bits.
    const below = base + LENGTHS + 3 * (Math.min(length, LENGTHS) - 1);
    let value = 1;
    for (let i = 0; i < length; i += 1) {
      const bit = i === 0 ? this.#bit(below) : i === 1 ? this.#bit(below + 1 + (value & 1)) : this.#told(WHOLE / 2);
      value = 2 * value + bit;
    }
    if (value > 0x1_0000_0000) throw new FrameError("A number in the frame has more than 32 bits.");
    this.#checkEnd();
    return value - 1;
  }

  byte(field: FieldNumber): number {
    const base = usual.starts[field]!;
    let known = 1;
    for (let i = 0; i < 8; i += 1) known = 2 * known + this.#bit(base + known);
    this.#checkEnd();
    return known - 256;
  }

  change(field: FieldNumber): number | null {
    return this.number(field) || null;
  }

  /** Nothing may be left. */
  end(): void {
    if (this.#read < this.bytes.length) throw new FrameError("Something follows the end of the body.");
  }

  /** Behind the end there are zeros without end, and they mean something as well. */
  #checkEnd(): void {
    if (this.#read > this.bytes.length + FLUSHED_BYTES) throw new FrameError("The frame is cut short.");
  }

  /** The next bit in a context, which learns from it. */
  #bit(context: number): number {
    const zero = this.#zeros[context]!;
    const bit = this.#told(Math.max(zero >>> 4, 1));
    const seen = this.#seen[context]!;
    const share = Math.floor((2 << 16) / (2 * seen + 3));
    const moved = bit === 1 ? -Math.floor((zero * share) / 65_536) : Math.floor(((65_536 - zero) * share) / 65_536);
    this.#zeros[context] = zero + moved;
    if (seen < MOST_SEEN) this.#seen[context] = seen + 1;
    return bit;
  }

  /** A bit that is 0 in so many cases of `WHOLE`. */
  #told(zero: number): number {
    const bound = (this.#range >>> 12) * zero;
    const bit = this.#code >= bound ? 1 : 0;
    if (bit === 1) {
      this.#code -= bound;
      this.#range -= bound;
    } else {
      this.#range = bound;
    }
    while (this.#range < LEAST_RANGE) {
      this.#range *= 256;
      this.#shift();
    }
    return bit;
  }

  #shift(): void {
    this.#code = ((this.#code << 8) | (this.bytes[this.#read] ?? 0)) >>> 0;
    this.#read += 1;
  }
}
