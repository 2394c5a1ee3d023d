import { describe, expect, test } from "vitest";
import { NUMBERS } from "../../document/growth/growth-parameters";
import { placeOf, stepsOf, valueAt } from "./travel";

const SHEDDING = NUMBERS.shedding_threshold;
const PLAIN = { least: 2, most: 6, step: 0.5 };

describe("where a value stands on a control", () => {
  test("by its share of the range where no part is named", () => {
    expect([2, 3, 6].map((value) => placeOf(PLAIN, value))).toEqual([0, 0.25, 1]);
    expect([0, 0.26, 1].map((place) => valueAt(PLAIN, place))).toEqual([2, 3, 6]);
    expect(placeOf({ ...PLAIN, most: 2 }, 2)).toBe(0);
  });

  test("shedding from 0.3 to 0.6 takes most of the travel, and all of its range is on it", () => {
    expect(SHEDDING.travel).toEqual([0.3, 0.6]);
    const places = [0, 0.3, 0.6, 1].map((value) => placeOf(SHEDDING, value));
    expect(places[0]).toBe(0);
    expect(places[2]! - places[1]!, "what does something fills the slider").toBeGreaterThanOrEqual(0.9);
    expect(places[1]).toBeGreaterThan(0);
    expect(places[2]).toBeLessThan(1);
    expect(places[3]).toBe(1);
  });

  test("every number of growth comes back from its place, to the step, in order", () => {
    for (const one of Object.values(NUMBERS)) {
      const steps = Math.round((one.most - one.least) / one.step);
      let last = -1;
      for (let count = 0; count <= steps; count += 1) {
        const value = one.least + count * one.step;
        const place = placeOf(one, value);
        expect(place, `${one.name} ${value}`).toBeGreaterThan(last);
        expect(valueAt(one, place), one.name).toBeCloseTo(value, 6);
        last = place;
      }
      expect(last, one.name).toBeCloseTo(1, 6);
    }
  });

  test("beyond the ends is at the ends", () => {
    expect([placeOf(SHEDDING, -1), placeOf(SHEDDING, 2)]).toEqual([0, 1]);
    expect([valueAt(SHEDDING, -1), valueAt(SHEDDING, 2)]).toEqual([0, 1]);
  });

  test("a part at an end of the range leaves all the rest to the other", () => {
    const low = { least: 0, most: 10, step: 1, travel: [0, 2] as const };
    expect([0, 2, 10].map((value) => placeOf(low, value))).toEqual([0, 0.9, 1]);
    const whole = { least: 0, most: 10, step: 1, travel: [0, 10] as const };
    expect([0, 5, 10].map((value) => placeOf(whole, value))).toEqual([0, 0.5, 1]);
  });
});

test("arrows go by a step, pages by ten, and other keys are the browser's", () => {
  expect(["ArrowRight", "ArrowUp", "ArrowLeft", "ArrowDown"].map(stepsOf)).toEqual([1, 1, -1, -1]);
  expect(["PageUp", "PageDown", "Home", "a"].map(stepsOf)).toEqual([10, -10, null, null]);
});
