import { grown } from "../table/column";
import type { Limbs } from "./limbs";
import { addBend, type Borne } from "./statics";
import type { Wood } from "./wood";

/** Rounds of the search; each is nearer by the ratio of what the best and the second best shape describe. */
const ROUNDS = 4;

/** How limbs bend: node a of one turns by `weights[a]` C e under a wind with a pressure of 1 Pa along e. */
export class Shapes {
  /** Of the nodes of limbs that were looked at, in the order of `Limbs.rows`; the largest of a limb is 1 or −1. */
  readonly weights: Float64Array;
  /** C of the last limb, in radians for each Pa along x, y and z, column by column. */
  readonly compliance = new Float64Array(9);
  private readonly sum = new Float64Array(9);
  private turned = new Float64Array(9 * 64);
  private shares = new Float64Array(64);

  constructor(
    private readonly limbs: Limbs,
    private readonly wood: Wood,
    private readonly drag: Borne,
  ) {
    this.weights = new Float64Array(limbs.rows.length);
  }

  /**
   * Finds the one shape that comes nearest to how statics turns the nodes of a limb in winds along x and z. A node counts for its
   * length times the drag area of what it bears, because a turn moves all that is beyond.
   */
  find(limb: number): this {
    const { wood, drag, weights, compliance, sum, limbs } = this;
    const begin = limbs.begin[limb]!;
    const count = limbs.begin[limb + 1]! - begin;
    if (count > this.shares.length) {
      this.shares = grown(this.shares, 2 * count);
      this.turned = grown(this.turned, 9 * 2 * count);
    }
    const { turned, shares } = this;
    compliance.fill(0);
    for (let i = 0; i < count; i += 1) {
      const row = limbs.rows[begin + i]!;
      addBend(compliance, wood, drag, wood.dragArea, row);
      for (let e = 0; e < 9; e += 1) turned[9 * i + e] = compliance[e]!;
      shares[i] = wood.length[row]! * drag.weight[row]!;
    }
    for (let round = 0; round < ROUNDS; round += 1) {
      const size = levelProduct(compliance, 0, compliance);
      if (size === 0) break;
      sum.fill(0);
      let squares = 0;
      for (let i = 0; i < count; i += 1) {
        const weight = levelProduct(turned, 9 * i, compliance) / size;
        weights[begin + i] = weight;
        const counts = shares[i]! * weight;
        for (let e = 0; e < 9; e += 1) sum[e]! += turned[9 * i + e]! * counts;
        squares += shares[i]! * weight * weight;
      }
      for (let e = 0; e < 9; e += 1) compliance[e] = sum[e]! * (1 / squares);
    }
    let largest = 0;
    for (let i = begin; i < begin + count; i += 1) largest = Math.max(largest, Math.abs(weights[i]!));
    if (largest > 0) {
      for (let i = begin; i < begin + count; i += 1) weights[i]! /= largest;
      for (let e = 0; e < 9; e += 1) compliance[e]! *= largest;
    }
    return this;
  }
}

/** The inner product of rotations under winds along x and z. */
function levelProduct(a: Float64Array, from: number, b: Float64Array): number {
  const x = a[from]! * b[0]! + a[from + 1]! * b[1]! + a[from + 2]! * b[2]!;
  return x + (a[from + 6]! * b[6]! + a[from + 7]! * b[7]! + a[from + 8]! * b[8]!);
}
