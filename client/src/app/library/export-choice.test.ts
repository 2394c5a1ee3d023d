import { describe, expect, it } from "vitest";
import type { ExportFormat } from "../../wire/generated";
import { bytesExpected, FIRST_CHOICE, isExportChoice, optionsOf } from "./export-choice";

const GLB: ExportFormat = {
  ending: "glb",
  options: ["lod", "quantised", "author"],
  bytes: [1000, 10, 20],
  levels: [1, 0.5, 0.1, 0],
  shares: { quantised: [0.5, 0.25] },
};

describe("a choice", () => {
  it("asks only for what the format has", () => {
    const choice = { ...FIRST_CHOICE, lod: "2", on: ["quantised", "hull"], author: " Ada ", licence: "CC0-1.0" };
    expect([...optionsOf(choice, GLB)]).toEqual([
      ["lod", "2"],
      ["quantised", "true"],
      ["author", "Ada"],
    ]);
    expect([...optionsOf(FIRST_CHOICE, GLB)]).toEqual([]);
  });

  it("is about as large as the format says", () => {
    const tree = { metamers: 100, leaves: 10 };
    expect(bytesExpected(GLB, new Map(), tree)).toBe(2200);
    expect(bytesExpected(GLB, new Map([["quantised", "true"]]), tree)).toBe(1550);
    expect(bytesExpected(GLB, new Map([["lod", "set"]]), tree)).toBeCloseTo(2920);
    expect(bytesExpected(GLB, new Map([["lod", "3"]]), tree)).toBe(1000);
  });

  it("that something else was kept as is none", () => {
    expect(isExportChoice(FIRST_CHOICE)).toBe(true);
    for (const other of [null, 3, {}, { ...FIRST_CHOICE, on: "hull" }, { ...FIRST_CHOICE, lod: 1 }]) {
      expect(isExportChoice(other)).toBe(false);
    }
  });
});
