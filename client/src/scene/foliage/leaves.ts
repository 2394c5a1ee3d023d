import { leafHash } from "../leaf-hash";

const GOLDEN_ANGLE = 2.39996323;

/** The azimuth of leaf `k` of `count` on a row's metamer (LF2), 0 to 2π: single precision would lose it otherwise. */
export function leafAzimuth(row: number, k: number, count: number): number {
  return (GOLDEN_ANGLE * row + (2 * Math.PI * k) / count) % (2 * Math.PI);
}

/** The random number of a leaf's size (LF2), 0 to 1. */
export function leafRandom(row: number, k: number): number {
  return leafHash(16 * row + k) / 2 ** 32;
}
