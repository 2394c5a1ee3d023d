import { describe, expect, it } from "vitest";
import { colourBy, factorsOf } from "./dyes";

describe("dyes", () => {
  it("are read back from the colours that they give", () => {
    const base: [number, number, number] = [121, 110, 97];
    expect(colourBy(base, [1, 1, 1])).toEqual(base);
    for (const colour of [
      [200, 90, 14],
      [3, 110, 170],
    ] as [number, number, number][]) {
      expect(colourBy(base, factorsOf(base, colour))).toEqual(colour);
    }
  });

  it("stay in range, and change nothing that has no light", () => {
    expect(factorsOf([10, 0, 100], [255, 90, 100])).toEqual([4, 1, 1]);
    expect(colourBy([255, 0, 100], [4, 4, 1])).toEqual([255, 0, 100]);
  });
});
