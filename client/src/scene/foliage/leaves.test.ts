import { expect, it } from "vitest";
import { leafHash } from "../leaf-hash";
import { leafAzimuth, leafRandom } from "./leaves";

it("LF3: a leaf hashes in 32-bit arithmetic", () => {
  expect([0, 1, 16, 82, 1599998].map(leafHash)).toEqual([129708002, 2831084092, 980210444, 1877514304, 922964444]);
});

it("LF2: a leaf's azimuth and size follow from its row", () => {
  expect(leafAzimuth(7, 1, 3)).toBeCloseTo((2.39996323 * 7 + (2 * Math.PI) / 3) % (2 * Math.PI), 12);
  expect(leafAzimuth(123456, 14, 15)).toBeLessThan(2 * Math.PI);
  expect(0.75 + 0.5 * leafRandom(7, 1)).toBeCloseTo(1.147272, 6);
  expect(0.75 + 0.5 * leafRandom(123456, 14)).toBeCloseTo(0.92693, 5);
});
