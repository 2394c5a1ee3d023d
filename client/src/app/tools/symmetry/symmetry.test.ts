import { describe, expect, it } from "vitest";
import { MOST_BRUSHES } from "../../../scene/glsl/environment";
import type { Vec3 } from "../../../scene/vector";
import { copiesOf, isSymmetry, MOST_AROUND, OFF } from "./symmetry";

const frame = { foot: [10, 0, -3] as Vec3, mirrorNormal: [1, 0, 0] as Vec3 };
const places = (symmetry: Parameters<typeof copiesOf>[0], point: Vec3) =>
  copiesOf(symmetry, frame).map(({ place }) => place(point).map((value) => Math.round(1e6 * value) / 1e6 + 0));

describe("symmetry", () => {
  it("off is the stroke alone", () => {
    expect(places(OFF, [14, 5, -1])).toEqual([[14, 5, -1]]);
  });

  it("mirrors across the trunk", () => {
    expect(places({ ...OFF, kind: "mirror" }, [14, 5, -1])).toEqual([
      [14, 5, -1],
      [6, 5, -1],
    ]);
  });

  it("repeats around the trunk, with mirror images where they are asked for", () => {
    expect(places({ ...OFF, kind: "around", around: 4 }, [14, 5, -3])).toEqual([
      [14, 5, -3],
      [10, 5, -7],
      [6, 5, -3],
      [10, 5, 1],
    ]);
    expect(places({ kind: "around", around: 2, mirrored: true }, [14, 5, -1])).toEqual([
      [14, 5, -1],
      [6, 5, -1],
      [6, 5, -5],
      [14, 5, -5],
    ]);
    const most = copiesOf({ kind: "around", around: MOST_AROUND, mirrored: true }, frame);
    expect(most.length, "all of them can be shown").toBeLessThanOrEqual(MOST_BRUSHES);
  });

  it("keeps heights and distances from the axis, and turns directions as it turns places", () => {
    const [a, b]: [Vec3, Vec3] = [
      [13, 2, 4],
      [15, 7, -9],
    ];
    for (const { place, direction } of copiesOf({ kind: "around", around: 7, mirrored: true }, frame)) {
      const [from, to] = [place(a), place(b)];
      expect([from[1], to[1]]).toEqual([2, 7]);
      expect(Math.hypot(from[0] - 10, from[2] + 3)).toBeCloseTo(Math.hypot(3, 7));
      const turned = direction([2, 5, -13]);
      for (const axis of [0, 1, 2] as const) expect(turned[axis]).toBeCloseTo(to[axis] - from[axis]);
    }
  });

  it("takes nothing else for one", () => {
    const wrong = [null, 3, {}, { ...OFF, kind: "spiral" }, { ...OFF, around: 9 }, { ...OFF, around: 2.5 }];
    expect([OFF, { ...OFF, around: 8 }].every(isSymmetry)).toBe(true);
    expect(wrong.some(isSymmetry)).toBe(false);
  });
});
