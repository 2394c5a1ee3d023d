import { describe, expect, it } from "vitest";
import { lattice, NOISE_SIDE } from "./noise-texture";

const values = lattice(NOISE_SIDE ** 3, 1);
const mean = (numbers: Iterable<number>) => {
  const all = [...numbers];
  return all.reduce((sum, value) => sum + value, 0) / all.length;
};

describe("noise lattice", () => {
  it("uses every value about equally often", () => {
    const often = new Array<number>(256).fill(0);
    for (const value of values) often[value]! += 1;
    expect(Math.min(...often)).toBeGreaterThan(64);
    expect(Math.max(...often)).toBeLessThan(192);
    expect(mean(values)).toBeCloseTo(127.5, -1);
  });

  it("neighbours have nothing in common", () => {
    for (const step of [1, NOISE_SIDE, NOISE_SIDE ** 2]) {
      const covariance = mean(
        Array.from({ length: values.length - step }, (_, i) => (values[i]! - 127.5) * (values[i + step]! - 127.5)),
      );
      // The variance of one value is 256² / 12.
      expect(Math.abs(covariance) / (256 ** 2 / 12)).toBeLessThan(0.03);
    }
  });

  it("another seed is another lattice", () => {
    const other = lattice(values.length, 2);
    const same = values.filter((value, i) => value === other[i]).length;
    expect(same / values.length).toBeLessThan(0.01);
  });
});
