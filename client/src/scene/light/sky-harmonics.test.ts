import { describe, expect, it } from "vitest";
import { DEFAULT_APPEARANCE } from "../../wire/generated";
import type { Vec3 } from "../vector";
import { type Harmonics, harmonicsOf, skyAt, studioOf } from "./sky-harmonics";
import { skyLight } from "./sky-light";

const under = (sun_elevation: number, sky: "meadow" | "overcast" | "clear" = "clear") =>
  skyLight({ ...DEFAULT_APPEARANCE.background, sky, sun_elevation, sun_azimuth: 90 });

/** As `ambient` of the shaders has it. */
function ambient(a: Harmonics, [x, y, z]: Vec3): number[] {
  const parts = [1, y, z, x, x * y, y * z, 3 * y * y - 1, x * z, x * x - z * z];
  return [0, 1, 2].map((c) =>
    Math.max(
      0,
      parts.reduce((sum, part, i) => sum + part * a[i]![c]!, 0),
    ),
  );
}

const UP: Vec3 = [0, 1, 0];
/** Towards the sun and away from it: it stands at 90° from z towards x. */
const SUNNY: Vec3 = [1, 0, 0];
const SHADY: Vec3 = [-1, 0, 0];

describe("light from all around", () => {
  it.each([60, 20, 6])("is above what it is known to be, under a sun at %i°", (elevation) => {
    const light = under(elevation);
    const top = ambient(harmonicsOf(light), UP);
    for (let c = 0; c < 3; c += 1) {
      expect(top[c]! / (0.8 * light.above[c]!)).toBeGreaterThan(0.9);
      expect(top[c]! / (0.8 * light.above[c]!)).toBeLessThan(1.1);
    }
  });

  it("is that of all directions together, for what looks to the side too", () => {
    const light = under(20);
    const harmonics = harmonicsOf(light);
    let scale = 0;
    const many = 20_000;
    const looks = Array.from({ length: many }, (_, n): Vec3 => {
      const y = 1 - (2 * n + 1) / many;
      const turn = 2.399963229728653 * n;
      return [Math.sqrt(1 - y * y) * Math.cos(turn), y, Math.sqrt(1 - y * y) * Math.sin(turn)];
    });
    for (const look of looks) if (look[1] > 0) scale += (4 * skyAt(light, look)[1] * look[1]) / many;
    for (const normal of [UP, SUNNY, SHADY, [0, 0, 1], [0.6, 0.8, 0]] as Vec3[]) {
      let sum = 0;
      for (const look of looks) {
        const facing = look[0] * normal[0] + look[1] * normal[1] + look[2] * normal[2];
        const from = look[1] > 0 ? (light.above[1] * skyAt(light, look)[1]) / scale : 0.55 * light.below[1];
        if (facing > 0) sum += (4 * 0.8 * facing * from) / many;
      }
      expect(ambient(harmonics, normal)[1]! / sum).toBeGreaterThan(0.93);
      expect(ambient(harmonics, normal)[1]! / sum).toBeLessThan(1.07);
    }
  });

  it("is warmer from where a low sun stands, and cooler from behind", () => {
    const low = harmonicsOf(under(5));
    const warmth = (normal: Vec3) => ambient(low, normal)[0]! / ambient(low, normal)[2]!;
    expect(warmth(SUNNY)).toBeGreaterThan(1.15 * warmth(SHADY));
  });

  it("comes from below as well, and never is less than nothing", () => {
    for (const elevation of [80, 30, 5, -4, -12]) {
      for (const sky of ["meadow", "overcast", "clear"] as const) {
        const harmonics = harmonicsOf(under(elevation, sky));
        for (const normal of [UP, SUNNY, SHADY, [0, -1, 0], [0, 0, -1]] as Vec3[]) {
          for (const value of ambient(harmonics, normal)) expect(value).toBeGreaterThan(0);
        }
      }
    }
  });

  describe("in a studio", () => {
    const light = skyLight({ ...DEFAULT_APPEARANCE.background, sky: "studio" });
    const harmonics = studioOf(light);
    const [x, , z] = light.towards;
    const sun = Math.atan2(x, z);
    const redAt = (y: number, turn: number) => {
      const flat = Math.sqrt(1 - y * y);
      return ambient(harmonics, [flat * Math.sin(sun + turn), y, flat * Math.cos(sun + turn)])[0]!;
    };

    it("is on the average around what a soft box and the floor give", () => {
      for (const y of [1, 0.3, -0.4, -1]) {
        const around = [0, 0.25, 0.5, 0.75].map((turn) => redAt(y, 2 * Math.PI * turn));
        const share = 0.5 + 0.5 * y;
        const mean = around.reduce((sum, red) => sum + red, 0) / 4;
        expect(mean).toBeCloseTo(0.8 * (0.55 * light.below[0] * (1 - share) + light.above[0] * share), 6);
      }
    });

    it("is brightest beside the lamp, and darkest between the walls", () => {
      const [lamp, left, across, right] = [0, 1, 2, 3].map((quarter) => redAt(0, (Math.PI / 2) * quarter));
      expect(lamp).toBeGreaterThan(1.2 * across!);
      expect(across).toBeGreaterThan(1.2 * left!);
      expect(left).toBeCloseTo(right!, 6);
      expect(left).toBeGreaterThan(0.1);
    });
  });
});
