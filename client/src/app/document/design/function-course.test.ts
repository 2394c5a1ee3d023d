import { describe, expect, it } from "vitest";
import { type Points, valueAt, valuesOf } from "./function-course";

describe("the course of a function", () => {
  it("goes through its points, and a line is straight", () => {
    const points: Points = [
      [0, 1],
      [0.25, 3],
      [0.5, 2],
      [1, 2],
    ];
    expect(
      valuesOf(
        points,
        points.map(([t]) => t),
      ),
    ).toEqual([1, 3, 2, 2]);
    const line: Points = [
      [0, 2],
      [1, 4],
    ];
    for (const t of [0, 0.3, 0.5, 1]) {
      expect(valueAt(line, t)).toBeCloseTo(2 + 2 * t);
    }
  });

  it("has the slopes of Fritsch and Butland, as the server's", () => {
    // By hand: slopes 3, 0 and 0.
    const points: Points = [
      [0, 0],
      [0.5, 1],
      [1, 1],
    ];
    expect(valueAt(points, 0.25)).toBeCloseTo(0.6875);
    expect(valueAt(points, 0.75)).toBeCloseTo(1);
  });

  it("goes beyond none of its points", () => {
    const steep: Points = [
      [0, 0],
      [0.1, 8],
      [0.2, 8],
      [0.9, 1],
      [1, 1],
    ];
    const values = valuesOf(
      steep,
      Array.from({ length: 101 }, (_, at) => at / 100),
    );
    expect(Math.max(...values)).toBe(8);
    expect(Math.min(...values)).toBe(0);
  });
});
