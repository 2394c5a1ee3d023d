import { describe, expect, it } from "vitest";
import { softly } from "./joints";
import { SPECIES } from "./species";
import { TABLE } from "./table";

/** A word so long may not fit beside others in a narrow panel; in a grid of choices it is less. */
const LONG = 13;
const LONG_CHOICE = 9;

const entries = Object.entries(TABLE) as [string, readonly [string, string]][];
/** What stands under pictures: the kinds, shapes and places to choose from. */
const CHOICE = /^(?!operations).*\.(kind|shape|place|sky|ground|vigor_model)\.(?!help)\w+$/;

function unbroken(labels: readonly string[], length: number): string[] {
  return labels.flatMap((label) => softly(label).match(/\p{L}+/gu) ?? []).filter((word) => word.length >= length);
}

describe("joints", () => {
  it("show only where a line is broken", () => {
    expect(softly("Verzweigungswinkel")).toBe("Verzweigungs\u00adwinkel");
    expect(softly("Zucker-Ahorn")).toBe("Zucker-Ahorn");
    expect(softly("Leaf")).toBe("Leaf");
  });

  it("long names of controls have them", () => {
    const names = entries.filter(([key]) => `${key}.help` in TABLE).map(([, [, german]]) => german);
    expect(names.length).toBeGreaterThan(50);
    expect(unbroken(names, LONG)).toEqual([]);
  });

  it("so have choices and species, which stand in narrow columns", () => {
    const choices = entries.filter(([key]) => CHOICE.test(key)).map(([, [, german]]) => german);
    expect(choices.length).toBeGreaterThan(30);
    const fitting = ["Wuchskraft", "Rangfolge", "Borchert", "Gefurcht", "Schuppig", "Blätternd", "Geringelt"];
    expect(unbroken(choices, LONG_CHOICE).filter((word) => !fitting.includes(word))).toEqual([]);
    const species = Object.values(SPECIES).map(([name]) => name);
    expect(unbroken(species, LONG - 2)).toEqual([]);
  });
});
