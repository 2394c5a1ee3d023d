import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { type Appearance, DEFAULT_APPEARANCE } from "../../../wire/generated";
import { LOOK_NUMBERS, type LookNumber, numberIn, patched, standardOf, withNumber } from "./look-numbers";

const names = Object.keys(LOOK_NUMBERS) as LookNumber[];

/** The protocol's own table: `section.field` to what is allowed. */
function tableOfProtocol(): Map<string, string> {
  const text = readFileSync(new URL("../../../../../proto/PROTOCOL.md", import.meta.url), "utf8");
  const [, table = ""] = /\n## Appearance of [^\n]*\n(.*?)\n## /s.exec(text) ?? [];
  const rows = new Map<string, string>();
  let sections: readonly string[] = [];
  for (const line of table.split("\n")) {
    const [, section = "", fields = "", , allowed = ""] = line.split("|").map((cell) => cell.trim());
    const named = /^`(\w+)`$/.exec(section)?.[1];
    sections = named ? [named] : section === "both" ? ["flowers", "fruits"] : sections;
    for (const [, field] of fields.matchAll(/`(\w+)`/g)) {
      for (const one of sections) rows.set(`${one}.${field}`, allowed);
    }
  }
  return rows;
}

describe("appearance", () => {
  it("AP1: every number has the protocol’s range", () => {
    const table = tableOfProtocol();
    expect(names.length).toBe(15);
    for (const name of names) {
      const { least, most } = LOOK_NUMBERS[name];
      const allowed = (table.get(name) ?? "").replaceAll("−", "-").replaceAll(/\([^)]*\)/g, "");
      const range = /^(-?[\d.]+) +to (-?[\d.]+)/.exec(allowed);
      expect([least, most], `${name}: ${allowed}`).toEqual([Number(range?.[1]), Number(range?.[2])]);
    }
  });

  it("every number of an appearance has a slider", () => {
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
