import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { radiusOf } from "../table/tree-table";
import { borne, swelling } from "./width-overlay";

interface Golden {
  exponent: number;
  twigDiameter: number;
  /** Radii of a limb, of what it bears and of what bears it, before and after its width is set. */
  samples: { before: number; after: number; above: [number, number][]; below: [number, number][] }[];
}

const server = new URL("../../../../server/", import.meta.url);
const golden = <T>(file: string): T => JSON.parse(readFileSync(new URL(file, server), "utf8"));

describe("the preview of a width", () => {
  const { exponent, twigDiameter, samples } = golden<Golden>("plant/golden/widths.json");
  const tip = twigDiameter / 2;

  it.each(samples)("finds the radii of the server: $before to $after", ({ before, after, above, below }) => {
    expect([above.length > 10, below.length >= 3]).toEqual([true, true]);
    const power = swelling(before / tip, after / tip);
    for (const [was, is] of above) {
      expect((tip * (was / tip) ** power) / is).toBeCloseTo(1, 4);
    }
    for (const [was, is] of below) {
      expect(borne(was, before, after, exponent) / is).toBeCloseTo(1, 4);
    }
  });
});

describe("codes of radii", () => {
  it.each(golden<[number, number][]>("mesh/golden/radius-codes.json"))(
    "%d is %d, as for the server",
    (code, radius) => {
      expect(radiusOf(code)).toBeCloseTo(radius, 3 - Math.floor(Math.log10(Math.max(radius, 1e-3))));
    },
  );
});
