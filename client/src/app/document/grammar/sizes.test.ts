import { describe, expect, it } from "vitest";
import { bars, deepest, internodesAt, type Sizes } from "./sizes";
import { stepFor } from "./slider-step";

const grown = (counts: readonly number[], ends: string | null, depth: number | null): Sizes => ({
  sizes: counts.map((internodes) => ({ modules: 3 * internodes, internodes })),
  ends: ends === null ? null : { id: "ends.counted", values: {}, message: ends },
  depth,
});

describe("how deep a plant may be derived", () => {
  const binary = Array.from({ length: 15 }, (_, depth) => 2 ** depth - 1);

  it("ends where the budget does", () => {
    expect(deepest(grown(binary, "too many", 12), 3)).toBe(14);
    expect(deepest(grown(binary.slice(0, 8), "too many", 12), 3)).toBe(7);
  });

  it("goes somewhat beyond what the text asks for", () => {
    expect(deepest(grown(binary, null, 4), 3)).toBe(8);
    expect(deepest(grown([], null, null), 0)).toBe(12);
    expect(deepest(grown([], null, null), 40)).toBe(40);
  });
});

describe("how large it is", () => {
  it("is told, or guessed as it went on", () => {
    const sizes = grown([1, 3, 7, 15], null, 4);
    expect(internodesAt(sizes, 2)).toEqual({ count: 7, isGuess: false });
    expect(internodesAt(sizes, 4)?.isGuess).toBe(true);
    expect(internodesAt(grown([100, 200, 400, 800], null, 4), 5)).toEqual({ count: 3200, isGuess: true });
    expect(internodesAt(grown([10, 20, 30, 40], null, 4), 6)).toEqual({ count: 70, isGuess: true });
    expect(internodesAt(grown([], null, 4), 6)).toBeNull();
  });

  it("stands in bars by its logarithm", () => {
    const shown = bars(grown([1, 10, 100, 1000], null, 3), 3, 24);
    expect(shown.map(({ depth }) => depth)).toEqual([0, 1, 2, 3]);
    expect(shown[3]?.height).toBe(1);
    expect(shown[1]?.height).toBeGreaterThan(0.3);
    expect(bars(grown([1, 2, 3], null, 160), 240, 24).length).toBeLessThanOrEqual(24);
  });
});

describe("the step of a slider", () => {
  it("is round, and fine enough for the value that the text has", () => {
    expect([stepFor(10, 60, 28), stepFor(0.6, 0.95, 0.82), stepFor(60, 180, 94.74), stepFor(0, 1, 0.123456)]).toEqual([
      0.1, 0.001, 0.01, 0.0001,
    ]);
  });
});
