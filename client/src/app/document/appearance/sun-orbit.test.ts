import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../../scene/vector";
import { around, azimuthOfEye, type ScreenAxes, SunDrag, shownAt, standingAt } from "./sun-orbit";

/** The screen's directions for an eye so far around the tree and so high, in degrees. */
function looking(yaw: number, pitch: number): ScreenAxes {
  const [a, e] = [(yaw * Math.PI) / 180, (pitch * Math.PI) / 180];
  const out: Vec3 = [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
  const right: Vec3 = [Math.cos(a), 0, -Math.sin(a)];
  const up: Vec3 = [
    out[1] * right[2] - out[2] * right[1],
    out[2] * right[0] - out[0] * right[2],
    out[0] * right[1] - out[1] * right[0],
  ];
  return [right, up, out];
}

describe("the sun on its dome", () => {
  it("is back where it was shown from any eye", () => {
    for (const yaw of [0, 47, 190, 333]) {
      for (const pitch of [-5, 20, 70]) {
        const axes = looking(yaw, pitch);
        for (const azimuth of [0, 15, 135, 260, 359]) {
          for (const elevation of [-9, 0, 33, 80]) {
            const back = standingAt(shownAt({ azimuth, elevation }, axes), axes);
            expect(Math.abs(((back.azimuth - azimuth + 540) % 360) - 180)).toBeLessThan(1e-6);
            expect(back.elevation).toBeCloseTo(elevation, 6);
          }
        }
      }
    }
  });

  it("stands before the tree on the eye's side", () => {
    const axes = looking(30, 0);
    expect(shownAt({ azimuth: 30, elevation: 0 }, axes)).toMatchObject({ before: true });
    expect(shownAt({ azimuth: 210, elevation: 0 }, axes)).toMatchObject({ before: false });
    expect(shownAt({ azimuth: 120, elevation: 0 }, axes).right).toBeCloseTo(1);
    expect(shownAt({ azimuth: 0, elevation: 90 }, axes).up).toBeCloseTo(1);
  });

  it("goes no lower than ten degrees below the horizon", () => {
    const axes = looking(0, 0);
    expect(standingAt({ right: 0, up: -0.9, before: true }, axes).elevation).toBe(-10);
    expect(standingAt({ right: 0, up: 5, before: true }, axes).elevation).toBe(90);
  });

  it("goes behind the tree past the rim and back", () => {
    const drag = new SunDrag(true);
    expect(drag.to(0.8, 0).before).toBe(true);
    expect(drag.to(1.1, 0).before).toBe(false);
    expect(drag.to(1.3, 0).before).toBe(false);
    expect(drag.to(0.7, 0).before).toBe(false);
    expect(drag.to(-1.1, 0).before).toBe(true);
    expect(drag.to(-0.5, 0).before).toBe(true);
  });

  it("knows from where the eye looks", () => {
    for (const yaw of [0, 90, 200, 359]) expect(azimuthOfEye(looking(yaw, 25))).toBeCloseTo(yaw, 6);
    expect(around(-10)).toBe(350);
    expect(around(720)).toBe(0);
  });
});
