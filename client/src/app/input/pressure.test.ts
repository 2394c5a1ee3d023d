import { describe, expect, it } from "vitest";
import { FeltPressure, radiusShare } from "./pressure";

describe("pen pressure", () => {
  it("half pressure is the chosen radius", () => {
    expect(radiusShare(0.5)).toBeCloseTo(1);
  });

  it("a firmer pen never draws narrower", () => {
    const shares = Array.from({ length: 101 }, (_, i) => radiusShare(i / 100));
    expect(shares.every((share, i) => i === 0 || share > shares[i - 1]!)).toBe(true);
    expect(shares[0]).toBeCloseTo(0.2);
    expect(shares[100]).toBeCloseTo(1.8);
  });

  it("neighbouring pressures differ little", () => {
    for (let p = 0; p < 1; p += 0.01) {
      expect(radiusShare(p + 0.01) - radiusShare(p)).toBeLessThan(0.026);
    }
  });

  it("pressures outside 0 to 1 are the nearest inside", () => {
    expect(radiusShare(-3)).toBe(radiusShare(0));
    expect(radiusShare(7)).toBe(radiusShare(1));
  });

  it("a jump of pressure is felt over several samples", () => {
    const felt = new FeltPressure();
    expect(felt.follow(0.2)).toBe(0.2);
    const steps = Array.from({ length: 12 }, () => felt.follow(0.8)!);
    expect(steps[0]).toBeLessThan(0.5);
    expect(steps.every((step, i) => i === 0 || step > steps[i - 1]!)).toBe(true);
    expect(steps[11]).toBeCloseTo(0.8, 1);
  });

  it("a finger has no pressure to follow", () => {
    const felt = new FeltPressure();
    felt.follow(0.9);
    expect(felt.follow(null)).toBeNull();
    expect(felt.follow(0.4)).toBe(0.4);
  });
});
