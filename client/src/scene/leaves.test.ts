import { describe, expect, it } from "vitest";
import { LEAF_NUMBERS, leafHash, placeLeaf } from "./leaves";

/** Expected numbers come from a separate program that follows the rules in double precision. */
function check(row: number, k: number, count: number, a: number[], b: number[], expected: number[]) {
  const position = new Float32Array([...a, ...b]);
  const out = new Float32Array(LEAF_NUMBERS);
  expect(placeLeaf(out, 0, row, k, count, position, 0, 1)).toBe(true);
  for (const [i, value] of expected.entries()) expect(out[i], `number ${i}`).toBeCloseTo(value, 4);
}

describe("a leaf", () => {
  it("LF3: hashes in 32-bit arithmetic", () => {
    expect([0, 1, 16, 82, 1599998].map(leafHash)).toEqual([129708002, 2831084092, 980210444, 1877514304, 922964444]);
  });

  it("LF1, LF2: stands around a slanting metamer", () => {
    check(
      7,
      1,
      3,
      [0.5, 2.25, -1],
      [1.25, 2.75, -0.5],
      [1.0, 2.583333, -0.666667, 1.147272, -0.102595, 0.060003, 0.992912, 0.006167, 0.998198, -0.059685],
    );
  });

  it("LF1: takes X as the reference on a vertical metamer", () => {
    check(
      41,
      0,
      1,
      [0, 1, 0],
      [0, 2, 0],
      [0.0, 2.0, 0.0, 1.114969, 0.784699, 0.374711, 0.493801, -0.317142, 0.927142, -0.199573],
    );
  });

  it("LF2: the last of many leaves stands at the end", () => {
    check(
      123456,
      14,
      15,
      [-3, 10, 4],
      [-3.5, 9.25, 4.25],
      [-3.5, 9.25, 4.25, 0.92693, -0.852279, -0.31646, -0.416502, -0.284325, 0.948606, -0.138947],
    );
  });

  it("has no place on a metamer without length", () => {
    const out = new Float32Array(LEAF_NUMBERS);
    expect(placeLeaf(out, 0, 3, 0, 2, new Float32Array([1, 2, 3, 1, 2, 3]), 0, 1)).toBe(false);
  });
});
