import { afterEach, describe, expect, it } from "vitest";
import { numberText, onStep, typedNumber, unitText } from "./number-text";
import { language } from "./say";

afterEach(() => {
  language.value = "en";
});

describe("numbers in controls", () => {
  it("are written with the digits a step can change", () => {
    expect(numberText(0.52, 0.005)).toBe("0.520");
    expect(numberText(4, 1)).toBe("4");
    expect(numberText(1234.5, 0.1)).toBe("1234.5");
    expect(numberText(-0.5, 0.01)).toBe("−0.50");
    expect(numberText(-0.001, 0.01)).toBe("0.00");
  });

  it("are written as the language writes them", () => {
    language.value = "de";
    expect(numberText(0.52, 0.01)).toBe("0,52");
  });

  it.each([
    ["0.52", 0.52],
    ["0,52", 0.52],
    [" -3 ", -3],
    ["−3,5°", -3.5],
    [".5", 0.5],
    ["12 steps", 12],
    ["7.", 7],
  ])("typed as %s is understood", (text, value) => {
    expect(typedNumber(text)).toBe(value);
  });

  it.each(["", "  ", "-", "abc", "."])("what is no number is none: %s", (text) => {
    expect(typedNumber(text)).toBeNull();
  });

  it("what is written can be read again", () => {
    for (const spoken of ["en", "de"] as const) {
      language.value = spoken;
      for (const value of [-0.99, 0, 0.125, 1, 137.5]) expect(typedNumber(numberText(value, 0.001))).toBe(value);
    }
  });

  it("what is typed is put on a step within range", () => {
    expect(onStep(0.5234, 0.4, 0.7, 0.005)).toBe(0.525);
    expect(onStep(9, 0.4, 0.7, 0.005)).toBe(0.7);
    expect(onStep(-9, -0.99, 0.99, 0.01)).toBe(-0.99);
    expect(onStep(0.3, 0, 1, 0.1)).toBe(0.3);
  });

  it("a degree sign stands close, a word apart", () => {
    expect(unitText("°")).toBe("°");
    expect(unitText("m")).toBe(" m");
    expect(unitText("")).toBe("");
  });
});
