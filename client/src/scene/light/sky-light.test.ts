import { describe, expect, it } from "vitest";
import { type Background, DEFAULT_APPEARANCE, type Ground, type Sky } from "../../wire/generated";
import type { Vec3 } from "../vector";
import { type SkyLight, skyLight } from "./sky-light";

const under = (fields: Partial<Background>) => skyLight({ ...DEFAULT_APPEARANCE.background, ...fields });
const bright = ([r, g, b]: Vec3) => 0.21 * r + 0.72 * g + 0.07 * b;
const warmth = ([r, , b]: Vec3) => r / Math.max(b, 1e-6);
const SKIES: readonly Sky[] = ["meadow", "clear", "overcast", "studio"];
const GROUNDS: readonly Ground[] = ["grass", "earth", "sand", "snow", "plain"];
/** What falls on a level place. */
const falls = (light: SkyLight) => bright(light.sun) * light.towards[1] + bright(light.above);

describe("light of the sky", () => {
  it("comes from where the sun is: from z towards x, and up", () => {
    const near = (light: SkyLight, expected: Vec3) => {
      for (const axis of [0, 1, 2] as const) expect(light.towards[axis]).toBeCloseTo(expected[axis], 5);
    };
    near(under({ sun_azimuth: 90, sun_elevation: 30 }), [Math.cos(Math.PI / 6), 0.5, 0]);
    near(under({ sun_azimuth: 0, sun_elevation: 90 }), [0, 1, 0]);
  });

  it("gets warmer and less as the sun sets", () => {
    const hours = [60, 20, 7, 0].map((sun_elevation) => under({ sun_elevation }));
    for (const [i, later] of hours.slice(1).entries()) {
      expect(warmth(later.sun)).toBeGreaterThan(warmth(hours[i]!.sun));
      expect(falls(later)).toBeLessThan(falls(hours[i]!));
    }
  });

  it("is the moon's at night, blue and from above", () => {
    const night = under({ sun_elevation: -10 });
    expect(night.towards[1]).toBeGreaterThan(0.3);
    expect(warmth(night.sun)).toBeLessThan(1);
    expect(bright(night.sun)).toBeGreaterThan(0.1);
    expect(night.stars).toBeGreaterThan(0);
    expect(under({ sun_elevation: 10 }).stars).toBe(0);
  });

  it("changes hands from sun to moon while neither shines", () => {
    for (const sun_elevation of [-4.4, -4.5, -4.6]) {
      expect(bright(under({ sun_elevation }).sun)).toBeLessThan(0.05);
    }
  });

  it("never jumps as the sun moves", () => {
    for (const sky of SKIES) {
      for (let elevation = -10; elevation < 90; elevation += 0.25) {
        const [a, b] = [under({ sky, sun_elevation: elevation }), under({ sky, sun_elevation: elevation + 0.25 })];
        for (const name of ["sun", "above", "below", "zenith", "middle", "horizon", "cloud"] as const) {
          expect(Math.abs(bright(a[name]) - bright(b[name])), `${sky} ${name} at ${elevation}°`).toBeLessThan(0.13);
        }
      }
    }
  });

  it("every sky over every ground is finite and lets a tree be seen", () => {
    for (const sky of SKIES) {
      for (const ground of GROUNDS) {
        for (const sun_elevation of [-10, -5, 0, 5, 45, 90]) {
          const light = under({ sky, ground, sun_elevation });
          expect(falls(light)).toBeGreaterThan(0.12);
          expect(light.towards[1]).toBeGreaterThan(0);
          for (const value of Object.values(light).flat()) expect(Number.isFinite(value)).toBe(true);
        }
      }
    }
  });

  it("an overcast sky casts the faintest shadow, snow sends back the most", () => {
    const share = (light: SkyLight) => bright(light.sun) / bright(light.above);
    expect(share(under({ sky: "overcast" }))).toBeLessThan(0.2 * share(under({ sky: "clear" })));
    const below = GROUNDS.map((ground) => bright(under({ ground }).below));
    expect(Math.max(...below)).toBe(below[GROUNDS.indexOf("snow")]);
  });
});
