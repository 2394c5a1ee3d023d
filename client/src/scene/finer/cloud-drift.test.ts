import { expect, it } from "vitest";
import { DEFAULT_APPEARANCE } from "../../wire/generated";
import { cloudDrift } from "./cloud-drift";

const { background } = DEFAULT_APPEARANCE;
const driftAt = (sun_azimuth: number, sun_elevation: number) =>
  cloudDrift({ ...background, sun_azimuth, sun_elevation });

it("clouds are elsewhere at another hour, and never far from where they were just before", () => {
  expect(cloudDrift(background)).toBe(0);
  const drifts = Array.from({ length: 361 }, (_, azimuth) => driftAt(azimuth, 20));
  for (const [i, drift] of drifts.slice(1).entries()) expect(Math.abs(drift - drifts[i]!)).toBeLessThan(0.015);
  expect(Math.max(...drifts) - Math.min(...drifts)).toBeGreaterThan(1);
  expect(drifts[360]).toBeCloseTo(drifts[0]!, 9);
  expect(Math.abs(driftAt(background.sun_azimuth, 20))).toBeGreaterThan(0.2);
});
