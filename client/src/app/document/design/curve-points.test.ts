import { describe, expect, it } from "vitest";
import { added, type Curve, mirrored, moved, STRAIGHT, without } from "./curve-points";

const BENT: Curve = [
  [0, 0, 0],
  [0.2, 0.4, 0.1],
  [0, 1, 0],
];

describe("the points of a course", () => {
  it("move in the plane that is seen, and the ends stay", () => {
    expect(moved(BENT, 1, 0, [-0.3, 0.5])[1]).toEqual([-0.3, 0.5, 0.1]);
    expect(moved(BENT, 1, 2, [-0.3, 0.5])[1]).toEqual([0.2, 0.5, -0.3]);
    expect(moved(BENT, 1, 0, [9, 0.5])[1]).toEqual([4, 0.5, 0.1]);
    expect([moved(BENT, 0, 0, [1, 1]), moved(BENT, 2, 0, [1, 2])]).toEqual([BENT, BENT]);
    const flat: Curve = [
      [0, 0, 0],
      [0.2, 0.4, 0],
      [0, 1, 0],
    ];
    expect(moved(flat, 1, 0, [0.001, 0.999])).toBe(flat);
  });

  it("come where they are tapped, at the depth that the course has there", () => {
    expect(added(STRAIGHT, 0, [0.3, 0.5])).toEqual({ value: [STRAIGHT[0], [0.3, 0.5, 0], STRAIGHT[1]], at: 1 });
    const upper = added(BENT, 2, [0.05, 0.8]);
    expect(upper?.at).toBe(2);
    expect(upper?.value[2]?.[0]).toBeGreaterThan(0.05);
    const lower = added(BENT, 0, [0.1, 0.15]);
    expect([lower?.at, lower?.value.length]).toEqual([1, 4]);
  });

  it("are 24 at most, and two at least", () => {
    const full: Curve = Array.from({ length: 24 }, (_, at) => [0, at / 23, 0] as const);
    expect(added(full, 0, [0.5, 0.5])).toBeNull();
    expect([without(BENT, 0), without(BENT, 2), without(BENT, 1)]).toEqual([null, null, STRAIGHT]);
  });

  it("are mirrored in the plane that is seen", () => {
    expect(mirrored(BENT, 0)[1]).toEqual([-0.2, 0.4, 0.1]);
    expect(mirrored(BENT, 2)[1]).toEqual([0.2, 0.4, -0.1]);
  });
});
