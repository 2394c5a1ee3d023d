import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Parameters } from "../wire/generated";
import { type NumberParameter, patchFor, SECTIONS, shownValue } from "./growth-parameters";

const all = SECTIONS.flatMap(({ parameters }) => parameters);
const numbers = all.filter((parameter): parameter is NumberParameter => parameter.kind === "number");

/** The table of parameters in the protocol's own words: name to range. */
function tableOfProtocol(): Map<string, string> {
  const text = readFileSync(new URL("../../../proto/PROTOCOL.md", import.meta.url), "utf8");
  const table = text.slice(text.indexOf("\n## Parameters"));
  const rows = new Map<string, string>();
  for (const line of table.split("\n")) {
    const cells = line.split("|").map((cell) => cell.trim());
    for (const [, name] of cells[1]?.matchAll(/`(\w+)`/g) ?? []) {
      rows.set(name!, cells[4] ?? "");
    }
  }
  return rows;
}

describe("growth parameters", () => {
  it("are those of the protocol, each once", () => {
    expect(all.map(({ name }) => name).sort()).toEqual([...tableOfProtocol().keys()].sort());
  });

  it("have the ranges of the protocol", () => {
    const table = tableOfProtocol();
    expect(numbers.length).toBeGreaterThan(30);
    for (const { name, least, most } of numbers) {
      const range = /^(\S+) to ([\d.]+)/.exec((table.get(name) ?? "").replace("−", "-"));
      expect([least, most], name).toEqual([Number(range?.[1]), Number(range?.[2])]);
    }
  });

  it("a slider's steps reach both ends of its range", () => {
    for (const { name, least, most, step } of numbers) {
      const steps = (most - least) / step;
      expect(Math.abs(steps - Math.round(steps)), name).toBeLessThan(1e-6);
    }
  });

  it.each([
    [0.5, 0.25, 0.25, 0.8],
    [1, 0, 0, 0.3],
    [0.2, 0.5, 0.3, 0],
    [0.34, 0.33, 0.33, 1],
  ])("weights %d, %d, %d stay 1 together when the first is %d", (heading, tropism, space, value) => {
    const now = { heading_weight: heading, tropism_weight: tropism, space_weight: space } as Parameters;
    const patch = patchFor("heading_weight", value, now);
    expect(patch.heading_weight).toBe(value);
    const weights = [patch.heading_weight!, patch.tropism_weight!, patch.space_weight!];
    expect(weights.every((weight) => weight >= 0 && weight <= 1)).toBe(true);
    expect(weights.reduce((sum, weight) => sum + weight)).toBeCloseTo(1, 9);
    if (tropism + space > 0 && value < 1) {
      expect(patch.tropism_weight! / (1 - value), "the others keep their proportion").toBeCloseTo(
        tropism / (tropism + space),
        2,
      );
    }
  });

  it("any other number is set alone", () => {
    expect(patchFor("leaf_size", 2, {} as Parameters)).toEqual({ leaf_size: 2 });
  });

  it("values are read with the digits that matter", () => {
    const named = (name: string) => numbers.find((parameter) => parameter.name === name)!;
    expect(shownValue(named("apical_control"), 0.52)).toBe("0.520");
    expect(shownValue(named("phyllotactic_angle"), 137.5)).toBe("137.5°");
    expect(shownValue(named("max_shoot_length"), 4)).toBe("4");
    expect(shownValue(named("marker_max_age"), 8)).toBe("8 steps");
    expect(shownValue(named("gravimorphism_shift"), -0.5)).toBe("−0.50");
  });
});
