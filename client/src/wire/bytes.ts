import { FrameError } from "./frame-error";
import type { NumberSource } from "./numbers";

/** Reads little-endian frames byte by byte, whatever they are about; every read checks that the bytes are there. */
export class ByteReader implements NumberSource {
  private at = 0;

  constructor(private readonly bytes: Uint8Array) {}

  get done(): boolean {
    return this.at >= this.bytes.length;
  }

  /** How many bytes are left. */
  get left(): number {
    return this.bytes.length - this.at;
  }

  byte(): number {
    const value = this.bytes[this.at];
    if (value === undefined) throw new FrameError("The frame is cut short.");
    this.at += 1;
    return value;
  }

  /** Unsigned LEB128 of at most 32 bits (FR3). */
  varint(): number {
    let value = 0;
    let scale = 1;
    for (let i = 0; i < 5; i += 1) {
      const byte = this.byte();
      const part = byte & 0x7f;
      if (i === 4 && part > 0x0f) break;
      // Multiplied, not shifted: a shift would make the 32nd bit a sign.
      value += part * scale;
      if (byte < 0x80) return value;
      scale *= 128;
    }
    throw new FrameError("A number in the frame has more than 32 bits.");
  }

  number(): number {
    return this.varint();
  }

  change(): number | null {
    return this.done ? null : this.byte();
  }

  /** The signed integer that zigzag mapped to an unsigned one (FR3). */
  zigzag(): number {
    const value = this.varint();
    return (value >>> 1) ^ -(value & 1);
  }

  /** A little-endian IEEE 754 number of 32 bits. */
  float(): number {
    const four = this.take(4);
    return new DataView(four.buffer, four.byteOffset).getFloat32(0, true);
  }

  take(count: number): Uint8Array {
    if (this.bytes.length - this.at < count) throw new FrameError("The frame is cut short.");
    const taken = this.bytes.slice(this.at, this.at + count);
    this.at += count;
    return taken;
  }
}
