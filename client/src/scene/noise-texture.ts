import { Data3DTexture, DataTexture, LinearFilter, RedFormat, RepeatWrapping } from "three";
import { leafHash } from "./leaf-hash";

/** Cells after which noise in space repeats. */
export const NOISE_SIDE = 32;
/** Cells after which noise in a plane repeats. */
export const FLAT_NOISE_SIDE = 256;

/** Planes of noise lie so far from each other, for each step of their seeds. */
export const FLAT_NOISE_SHIFT = [17.13, 31.71] as const;

/** The lattice of noise in a plane. */
export const flatLattice = () => lattice(FLAT_NOISE_SIDE ** 2, 2);

/** Lattices of random values that shaders interpolate: far cheaper than hashing every corner for every pixel. */
export class NoiseTextures {
  readonly space = new Data3DTexture(lattice(NOISE_SIDE ** 3, 1), NOISE_SIDE, NOISE_SIDE, NOISE_SIDE);
  readonly plane = new DataTexture(flatLattice(), FLAT_NOISE_SIDE, FLAT_NOISE_SIDE);

  constructor() {
    this.space.wrapR = RepeatWrapping;
    for (const texture of [this.space, this.plane]) {
      texture.format = RedFormat;
      texture.wrapS = RepeatWrapping;
      texture.wrapT = RepeatWrapping;
      texture.minFilter = LinearFilter;
      texture.magFilter = LinearFilter;
      texture.unpackAlignment = 1;
      texture.needsUpdate = true;
    }
  }

  dispose(): void {
    this.space.dispose();
    this.plane.dispose();
  }
}

/** Random values from 0 to 255, the same in every browser. */
export function lattice(length: number, seed: number): Uint8Array<ArrayBuffer> {
  const values = new Uint8Array(length);
  for (let at = 0; at < length; at += 1) values[at] = leafHash(at + seed * 0x1000000) >>> 24;
  return values;
}
