import { describe, expect, it } from "vitest";
import { keyNamed } from "./design-model";
import { MOST_POINTS, type Points, valueAt } from "./function-course";
import { extentOf, relativeExtents } from "./function-extents";
import { combined, relativeTo } from "./relative-values";

const ANGLE = keyNamed("branching_angle");
const FALLING: Points = [
  [0, 80],
  [1, 40],
];
const RISING: Points = [
  [0, 0],
  [1, 2],
];
const BENT: Points = [
  [0, 10],
  [0.3, 70],
  [0.6, 20],
  [1, 60],
];

describe("values said relative to others", () => {
  it("multiplies place by place, as the server does", () => {
    const product = combined(FALLING, RISING, ANGLE, "factor") as Points;
    for (const t of [0, 0.25, 0.5, 0.8, 1]) {
      expect(valueAt(product, t)).toBeCloseTo((80 - 40 * t) * 2 * t, 0);
    }
    expect(product.length).toBeLessThanOrEqual(MOST_POINTS);
  });

  it("adds by no more points than it takes, and stays within the range of the parameter", () => {
    const sum = [
      [0, 20],
      [1, 20],
    ] as const;
    expect(combined(FALLING, sum, ANGLE, "offset")).toEqual([
      [0, 100],
      [1, 60],
    ]);
    const much: Points = [
      [0, 170],
      [1, 170],
    ];
    const most = (combined(BENT, much, ANGLE, "offset") as Points).map(([, value]) => value);
    expect(Math.max(...most)).toBe(180);
  });

  it.each(["offset", "factor"] as const)("says as an %s what a branch has already", (relation) => {
    const said = relativeTo(FALLING, BENT, ANGLE, relation) as Points;
    expect(said.length).toBeLessThanOrEqual(MOST_POINTS);
    const back = combined(FALLING, said, ANGLE, relation) as Points;
    for (const t of [0, 0.15, 0.3, 0.45, 0.6, 0.8, 1]) {
      expect(Math.abs(valueAt(back, t) - valueAt(BENT, t))).toBeLessThan(2);
    }
    const reach = keyNamed("reach");
    expect(combined(0.8, relativeTo(0.8, 1.2, reach, relation), reach, relation)).toBeCloseTo(1.2);
  });

  it("leaves what is inherited as it is, and takes no share of nothing", () => {
    expect(relativeTo(BENT, BENT, ANGLE, "factor")).toEqual([
      [0, 1],
      [1, 1],
    ]);
    expect(relativeTo(BENT, BENT, ANGLE, "offset")).toEqual([
      [0, 0],
      [1, 0],
    ]);
    expect(relativeTo(0, 5, keyNamed("roll"), "factor")).toBe(1);
  });
});

describe("what is drawn of a relative function", () => {
  const usual = { least: 0, most: 0 };
  const drawn = (points: Points, least: number, most: number) => ({
    points,
    range: { least, most },
    usual,
  });
  const result = { ...drawn(FALLING, 0, 180), usual: { least: 0, most: 120 } };

  it("has an offset about its middle, on the scale of what comes of it", () => {
    const { own, result: gets } = relativeExtents(drawn([[0, -10]], -180, 180), result, "offset");
    expect([own, gets]).toEqual([
      { bottom: -60, top: 60 },
      { bottom: 0, top: 120 },
    ]);
    const far = relativeExtents(drawn([[0, -100]], -180, 180), result, "offset");
    expect([far.own, far.result]).toEqual([
      { bottom: -150, top: 150 },
      { bottom: 0, top: 300 },
    ]);
  });

  it("begins at nothing, even where values cannot", () => {
    const taper = extentOf({ points: FALLING.map(([t, value]) => [t, value / 80]), range: keyNamed("taper"), usual });
    expect(taper).toEqual({ bottom: 0, top: 1.5 });
  });

  it("has the factor 1 in its middle as long as there is room", () => {
    const points = (most: number): Points => [
      [0, 1],
      [1, most],
    ];
    expect(relativeExtents(drawn(points(1.5), 0, 10), result, "factor").own).toEqual({ bottom: 0, top: 2 });
    expect(relativeExtents(drawn(points(4), 0, 10), result, "factor").own).toEqual({ bottom: 0, top: 5 });
    expect(relativeExtents(drawn(points(10), 0, 10), result, "factor").own.top).toBe(10);
  });
});
