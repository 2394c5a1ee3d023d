import { describe, expect, it } from "vitest";
import type { Programme } from "../../../../wire/generated";
import { NUMBERS } from "../../../document/growth/growth-parameters";
import { valuesAt } from "../../../document/growth/programme-control";
import { placeOf } from "../../controls/travel";
import { CurveScale, grippable, pointsOf, withChangeAt, withoutChange, withPoint } from "./programme-curve";

const SHEDDING = NUMBERS.shedding_threshold;

const pine: Programme = {
  parameters: { shedding_threshold: 0.25 },
  stages: [
    { kind: "change", age: 4, parameters: { shedding_threshold: 0.9 } },
    { kind: "change", age: 10, parameters: {} },
  ],
  age: 23,
};

describe("the curve of a parameter", () => {
  it("begins with what the programme begins with", () => {
    expect(pointsOf(pine, SHEDDING)).toEqual([
      { age: 0, value: 0.25, change: null },
      { age: 4, value: 0.9, change: 0 },
      { age: 10, value: 0.25, change: 1 },
    ]);
  });

  it("has a point where it is pulled to, between its neighbours and in range", () => {
    const moved = withPoint(pine, SHEDDING, 0, { age: 6.6, value: 0.503 });
    expect(pointsOf(moved, SHEDDING)[1]).toEqual({ age: 7, value: 0.5, change: 0 });
    const beyond = withPoint(pine, SHEDDING, 0, { age: 90, value: 7 });
    expect(pointsOf(beyond, SHEDDING)[1]).toEqual({ age: 9, value: 1, change: 0 });
    expect(valuesAt(withPoint(pine, SHEDDING, null, { age: 5, value: 0.1 }), 0).shedding_threshold).toBe(0.1);
  });

  it("keeps the weights of direction together", () => {
    const moved = withPoint(pine, NUMBERS.heading_weight, 0, { age: 4, value: 0.8 });
    const { heading_weight, tropism_weight, space_weight } = valuesAt(moved, 5);
    expect(heading_weight + tropism_weight + space_weight).toBeCloseTo(1);
  });

  it("has a stage more, and a stage less", () => {
    const more = withChangeAt(pine, 7);
    expect(pointsOf(more, SHEDDING).map(({ age, value }) => [age, value])).toEqual([
      [0, 0.25],
      [4, 0.9],
      [7, 0.9],
      [10, 0.25],
    ]);
    expect(withChangeAt(more, 7)).toBe(more);
    expect(withoutChange(more, 1)).toEqual(pine);
  });

  it("reads places as it draws them", () => {
    const scale = new CurveScale(SHEDDING, 20, { left: 10, top: 20, width: 200, height: 80 });
    const point = { age: 10, value: 0.25, change: null };
    expect(scale.at(scale.place(point))).toEqual({ age: 10, value: 0.25 });
    const flat = new CurveScale(NUMBERS.apical_control, 20, { left: 10, top: 20, width: 200, height: 80 });
    const middle = (NUMBERS.apical_control.least + NUMBERS.apical_control.most) / 2;
    expect(flat.path([{ ...point, value: middle }])).toBe("M110 60H210");
  });

  it("gives a value the place that it has on its slider", () => {
    expect(SHEDDING.travel).toEqual([0.3, 0.6]);
    const scale = new CurveScale(SHEDDING, 20, { left: 0, top: 20, width: 200, height: 100 });
    for (const value of [0, 0.25, 0.3, 0.45, 0.6, 1]) {
      expect(scale.y(value), `${value}`).toBeCloseTo(120 - 100 * placeOf(SHEDDING, value), 9);
      expect(scale.at({ x: 0, y: scale.y(value) }).value, `${value}`).toBe(value);
    }
    expect(scale.y(0.3) - scale.y(0.6), "what does something fills the curve").toBeGreaterThanOrEqual(90);
    expect([scale.at({ x: 0, y: 900 }), scale.at({ x: 0, y: -900 })].map(({ value }) => value)).toEqual([0, 1]);
  });

  it("has grips that lie apart, the chosen one's among them", () => {
    const frame = { left: 0, top: 0, width: 240, height: 100 };
    const scale = new CurveScale(SHEDDING, 24, frame);
    const change = (age: number) => ({ kind: "change", age, parameters: {} }) as const;
    const points = pointsOf({ ...pine, stages: [1, 2, 6, 7, 20].map(change) }, SHEDDING);
    const ages = (chosen: number) => grippable(points, points[chosen]!, scale).map(({ age }) => age);
    expect(ages(0)).toEqual([0, 6, 20]);
    expect(ages(4)).toEqual([7, 0, 20]);
  });
});
