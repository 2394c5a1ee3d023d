const GOLDEN_ANGLE = 2.39996323;

/** The hash of rule LF3, in 32-bit wrapping arithmetic. */
export function leafHash(input: number): number {
  const x = (Math.imul(input, 747796405) + 2891336453) >>> 0;
  const y = Math.imul((x >>> ((x >>> 28) + 4)) ^ x, 277803737) >>> 0;
  return ((y >>> 22) ^ y) >>> 0;
}

/** The azimuth of leaf `k` of `count` on a row's metamer (LF2), 0 to 2π: single precision would lose it otherwise. */
export function leafAzimuth(row: number, k: number, count: number): number {
  return (GOLDEN_ANGLE * row + (2 * Math.PI * k) / count) % (2 * Math.PI);
}

/** The random number of a leaf's size (LF2), 0 to 1. */
export function leafRandom(row: number, k: number): number {
  return leafHash(16 * row + k) / 2 ** 32;
}
