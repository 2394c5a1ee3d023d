import { describe, expect, it } from "vitest";
import { MAX_RADIUS, MIN_BRUSH, placeOf, radiusAt, radiusLabel, stepRadius } from "./brush-radius";

describe("brush radius", () => {
  it("runs from sketching to the widest brush", () => {
    expect([radiusAt(0), radiusAt(1), radiusAt(-3), radiusAt(9)]).toEqual([0, MAX_RADIUS, 0, MAX_RADIUS]);
  });

  it("never narrows upwards", () => {
    for (let i = 1; i <= 100; i++) {
      expect(radiusAt(i / 100)).toBeGreaterThanOrEqual(radiusAt((i - 1) / 100));
    }
  });

  it("finds the place of each radius again", () => {
    for (const radius of [MIN_BRUSH, 1, 4, 11, 40]) {
      expect(radiusAt(placeOf(radius))).toBeCloseTo(radius, 6);
    }
    expect(placeOf(0)).toBe(0);
  });

  it("steps out of sketching and back", () => {
    expect(stepRadius(0, 1)).toBeCloseTo(MIN_BRUSH, 6);
    expect(stepRadius(MIN_BRUSH, -1)).toBe(0);
    expect(stepRadius(MAX_RADIUS, 1)).toBeCloseTo(MAX_RADIUS, 6);
  });

  it("says what it means", () => {
    expect([radiusLabel(0), radiusLabel(3.16), radiusLabel(40)]).toEqual(["Sketch", "3.2", "40"]);
  });
});
