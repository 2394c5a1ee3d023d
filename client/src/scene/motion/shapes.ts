import { addBend, type Borne } from "./statics";
import type { Wood } from "./wood";

/** Rounds of the search; each is nearer by the ratio of what the best and the second best shape describe. */
const ROUNDS = 4;

/** How a limb bends: its node a turns by `weights[a]` C e under a wind with a pressure of 1 Pa along e. */
export interface Shape {
  /** C, in radians for each Pa along x, y and z, column by column. */
  readonly compliance: Float64Array;
  /** Node by node from the base up; the largest is 1 or −1. */
  readonly weights: Float64Array;
}

/**
 * The one shape that comes nearest to how statics turns the nodes of a limb in winds along x and z. A node counts for its length
 * times the drag area of what it bears, because a turn moves all that is beyond.
 */
export function shapeOf(wood: Wood, drag: Borne, rows: Int32Array): Shape {
  const count = rows.length;
  const turned = new Float64Array(9 * count);
  const shares = new Float64Array(count);
  const compliance = new Float64Array(9);
  for (let i = 0; i < count; i += 1) {
    const row = rows[i]!;
    addBend(compliance, wood, drag, wood.dragArea, row);
    turned.set(compliance, 9 * i);
    shares[i] = wood.length[row]! * drag.weight[row]!;
  }
  const weights = new Float64Array(count);
  const sum = new Float64Array(9);
  for (let round = 0; round < ROUNDS; round += 1) {
    const size = levelProduct(compliance, 0, compliance);
    if (size === 0) break;
    sum.fill(0);
    let squares = 0;
    for (let i = 0; i < count; i += 1) {
      const weight = levelProduct(turned, 9 * i, compliance) / size;
      weights[i] = weight;
      const counts = shares[i]! * weight;
      for (let e = 0; e < 9; e += 1) sum[e]! += turned[9 * i + e]! * counts;
      squares += shares[i]! * weight * weight;
    }
    for (let e = 0; e < 9; e += 1) compliance[e] = sum[e]! * (1 / squares);
  }
  let largest = 0;
  for (const weight of weights) largest = Math.max(largest, Math.abs(weight));
  if (largest > 0) {
    for (let i = 0; i < count; i += 1) weights[i]! /= largest;
    for (let e = 0; e < 9; e += 1) compliance[e]! *= largest;
  }
  return { compliance, weights };
}

/** The inner product of rotations under winds along x and z. */
function levelProduct(a: Float64Array, from: number, b: Float64Array): number {
  const x = a[from]! * b[0]! + a[from + 1]! * b[1]! + a[from + 2]! * b[2]!;
  return x + (a[from + 6]! * b[6]! + a[from + 7]! * b[7]! + a[from + 8]! * b[8]!);
}
