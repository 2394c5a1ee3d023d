import { describe, expect, it } from "vitest";
import { type Appearance, DEFAULT_APPEARANCE } from "../../../wire/generated";
import { LOOK_NUMBERS, type LookNumber, numberIn, patched, standardOf, withNumber } from "./look-numbers";

const names = Object.keys(LOOK_NUMBERS) as LookNumber[];

describe("appearance", () => {
  it("every number of an appearance has a range", () => {
    const numbers = Object.entries(DEFAULT_APPEARANCE).flatMap(([part, look]) =>
      Object.entries(look).flatMap(([field, value]) => (typeof value === "number" ? [`${part}.${field}`] : [])),
    );
    expect([...names].sort()).toEqual(numbers.sort());
  });

  it("a slider’s steps reach both ends and the default", () => {
    for (const name of names) {
      const { least, most, step } = LOOK_NUMBERS[name];
      for (const value of [most, standardOf(name)]) {
        const steps = (value - least) / step;
        expect(Math.abs(steps - Math.round(steps)), name).toBeLessThan(1e-6);
      }
    }
  });

  it("AP1: a number is set alone, all else stays", () => {
    for (const name of names) {
      const value = LOOK_NUMBERS[name].most;
      const patch = withNumber(name, value);
      const [part, field] = name.split(".") as [keyof Appearance, string];
      expect(patch).toEqual({ [part]: { [field]: value } });
      const looks = patched(DEFAULT_APPEARANCE, patch);
      for (const other of names) {
        expect(numberIn(looks, other)).toBe(other === name ? value : standardOf(other));
      }
    }
  });
});
