import { leafHash } from "../leaf-hash";

const GOLDEN_ANGLE = 2.39996323;

/**
 * The azimuth of leaf `k` of `count` on a row's metamer (LF2), 0 to 2π: single precision would lose it otherwise. A
 * salt gives other things than leaves places of their own.
 */
export function leafAzimuth(row: number, k: number, count: number, salt = 0): number {
  return (GOLDEN_ANGLE * row + (salt % 7) + (2 * Math.PI * k) / count) % (2 * Math.PI);
}

/** The random number of a leaf's size (LF2), 0 to 1, or of something else with a salt. */
export function leafRandom(row: number, k: number, salt = 0): number {
  return leafHash(16 * (row ^ salt) + k) / 2 ** 32;
}
