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

  it("has all of its way for what the picture has room for", () => {
    for (const widest of [1, 6.4, 18]) {
      expect(radiusAt(1, widest)).toBeCloseTo(widest, 6);
      expect(radiusAt(0.95, widest)).toBeLessThan(widest);
      expect(radiusAt(placeOf(0.8, widest), widest)).toBeCloseTo(0.8, 6);
      expect(placeOf(widest, widest)).toBeCloseTo(1, 6);
    }
  });

  it("still goes upwards where the picture has room for no brush at all", () => {
    expect(radiusAt(0.3, 0.2)).toBeGreaterThan(radiusAt(0.2, 0.2));
    expect(placeOf(MIN_BRUSH, 0.2)).toBeLessThan(placeOf(0.6, 0.2));
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
