import { afterEach, describe, expect, it, vi } from "vitest";
import type { Parameters } from "../../../wire/generated";
import { PARAMETERS } from "../../../wire/generated-tables";
import { language } from "../../words/say";
import {
  DEFAULTS,
  helpOf,
  NUMBERS,
  type NumberName,
  nameOf,
  OF_THE_BRUSH,
  OF_THE_LEAVES,
  patchFor,
  patchFrom,
  SECTIONS,
  shownValue,
  WIDGETS,
} from "./growth-parameters";

/** Where each parameter can be set, panel by panel. */
const all = [
  ...SECTIONS.flatMap(({ parameters }) => parameters),
  ...Object.values(WIDGETS).flat(),
  ...OF_THE_BRUSH,
  ...OF_THE_LEAVES,
];

/** The table with a number, a switch and a choice more in each group. */
function withEachKindInEachGroup(generated: typeof import("../../../wire/generated-tables")) {
  const added = [...new Set(Object.values(generated.PARAMETERS).map(({ group }) => group))].flatMap((group) => [
    [`${group}_number`, { kind: "number", least: 0, most: 1, step: 0.1, group }],
    [`${group}_switch`, { kind: "switch", group }],
    [`${group}_choice`, { kind: "choice", choices: ["one", "other"], group }],
  ]);
  return { ...generated, PARAMETERS: { ...generated.PARAMETERS, ...Object.fromEntries(added) } };
}

describe("growth parameters", () => {
  afterEach(() => {
    vi.doUnmock("../../../wire/generated-tables");
    vi.resetModules();
  });

  it("of each kind have a place in a panel, whatever their group", async () => {
    const table = withEachKindInEachGroup(await vi.importActual("../../../wire/generated-tables"));
    vi.resetModules();
    vi.doMock("../../../wire/generated-tables", () => table);
    const { SECTIONS, WIDGETS, OF_THE_BRUSH, OF_THE_LEAVES } = await import("./growth-parameters");
    const sections = SECTIONS.flatMap(({ parameters }) => parameters);
    const placed = [...sections, ...Object.values(WIDGETS).flat(), ...OF_THE_BRUSH, ...OF_THE_LEAVES];
    expect(placed.map(({ name }) => name).sort()).toEqual(Object.keys(table.PARAMETERS).sort());
  });

  it("are those of the table, each to be set in some panel", () => {
    const shown = new Set(all.map(({ name }) => name));
    expect([...shown].sort()).toEqual(Object.keys(PARAMETERS).sort());
  });

  it("stand in the order of importance, what is not named after what is", () => {
    const named = (title: string) =>
      SECTIONS.find((section) => section.title === title)?.parameters.map(({ name }) => name);
    expect(named("architecture.section.vigor")?.slice(0, 3)).toEqual([
      "apical_control",
      "light_sensitivity",
      "shedding_threshold",
    ]);
    expect(named("architecture.section.wood")?.slice(0, 2)).toEqual(["girth_exponent", "twig_diameter"]);
    const ofTheBrush = OF_THE_BRUSH.map(({ name }) => name);
    expect(ofTheBrush.slice(0, 2)).toEqual(["marker_density", "marker_max_age"]);
    expect(ofTheBrush.slice(2)).toContain("tropism_from_stroke");
  });

  it.each(["en", "de"] as const)("each has a name and a sentence of help (%s)", (spoken) => {
    language.value = spoken;
    for (const parameter of all) {
      expect(nameOf(parameter).length, parameter.name).toBeGreaterThan(2);
      expect(helpOf(parameter), parameter.name).toMatch(/^[A-ZÄÖÜ0-9].+\.$/);
    }
    language.value = "en";
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

  it("a group is reset to the values of another set", () => {
    const source = { ...DEFAULTS, branching_angle: 80, deflection_angle: 12 };
    expect(patchFrom(source, WIDGETS.fork)).toEqual({ branching_angle: 80, deflection_angle: 12 });
  });

  it("values are read with the digits that matter", () => {
    const shown = (name: NumberName, value: number) => shownValue(NUMBERS[name], value);
    expect(shown("apical_control", 0.52)).toBe("0.520");
    expect(shown("phyllotactic_angle", 137.5)).toBe("137.5°");
    expect(shown("max_shoot_length", 4)).toBe("4");
    expect(shown("marker_max_age", 8)).toBe("8 steps");
    expect(shown("gravimorphism_shift", -0.5)).toBe("−0.50");
    language.value = "de";
    expect(shown("internode_length", 0.105)).toBe("0,105 m");
    expect(shown("marker_max_age", 8)).toBe("8 Schritte");
    language.value = "en";
  });
});
