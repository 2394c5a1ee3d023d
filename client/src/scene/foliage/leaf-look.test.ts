import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { shaderFunctions } from "../../../test/shader-functions";
import { LEAF_NATURES, type LeafLook } from "../../wire/generated";
import { LEAF_COLOUR, LEAF_SHAPE } from "../glsl/leaf";
import { linear } from "../light/colours";
import { seasonOf } from "./leaf-season";

/** A look in its season, and the colours of some leaves, as the server's exports have them. */
interface Look {
  look: LeafLook;
  /** Unfolded, present, fresh, turned, withered. */
  season: number[];
  hues: { vigor: number; light: number; own: number[]; hue: number[]; margin: number[] }[];
}

interface Shape {
  random: number;
  own: number[];
  share: number;
  presence: number[];
  unfolding: number[];
  direction: number[];
  heading: number[];
  lean: number;
  orientation: number;
  bending: number[];
  pointing: number[];
}

/** A blade of a leaf that is divided into so many (LF6). */
interface Blade {
  direction: number[];
  normal: number[];
  random: number;
  count: number;
  number: number;
  bend: number;
  base: number[];
  way: number[];
  up: number[];
  size: number[];
  own: number[];
}

interface BladeFunctions {
  bladeOf(
    d: number[],
    n: number[],
    random: number,
    count: number,
    number: number,
    bend: number,
  ): { base: number[]; direction: number[]; normal: number[]; size: number; own: number };
}

interface ColourFunctions {
  leafHues(vigor: number, light: number, own: readonly number[]): { middle: number[]; margin: number[] };
}

interface ShapeFunctions {
  ownNumbers(random: number): number[];
  presence(share: number, number: number): number;
  unfolding(unfolded: number, number: number): number;
  bending(random: number, own: number): number[];
  pointing(d: number[], h: number[], side: number[], lean: number, turn: number): number[];
}

const file = new URL("../../../../server/export/golden/leaf-look.json", import.meta.url);
const samples: { looks: Look[]; shapes: Shape[]; blades: Blade[] } = JSON.parse(readFileSync(file, "utf8"));

function expectNear(found: ArrayLike<number>, wanted: readonly number[], tolerance: number) {
  expect(found.length).toBe(wanted.length);
  for (const [i, number] of wanted.entries()) expect(Math.abs(found[i]! - number)).toBeLessThan(tolerance);
}

describe.each(samples.looks)("$look.shape in season $look.season", ({ look, season, hues }) => {
  const { unfolded, present, fresh, turned, withered } = seasonOf(look.shape, look.season);

  it("comes as far as in exports", () => {
    expectNear([unfolded, present, fresh, turned, withered], season, 2e-5);
  });

  it("has the colours of exports", () => {
    const { is_spray, autumn } = LEAF_NATURES[look.shape];
    const { leafHues } = shaderFunctions<ColourFunctions>(LEAF_COLOUR, ["leafHues"], {
      uLeafForm: [0.5, is_spray ? 1 : 0, 0, 0],
      uLeafSeason: [unfolded, present, fresh, turned],
      uLeafTraits: [look.vigor_shift, look.orientation, withered, 0],
      uLeafTint: linear(look.tint),
      uLeafFirst: linear(autumn[0]),
      uLeafLast: linear(autumn[1]),
      uLeafDead: linear(autumn[2]),
    });
    for (const { vigor, light, own, hue, margin } of hues) {
      const found = leafHues(vigor, light, own);
      expectNear(found.middle, hue, 2e-4);
      expectNear(found.margin, margin, 2e-4);
    }
  });
});

it("leaves have the size and direction of those in exports", () => {
  const names = ["ownNumbers", "presence", "unfolding", "bending", "pointing"] as const;
  const shader = shaderFunctions<ShapeFunctions>(LEAF_SHAPE, names);
  expect(samples.shapes.length).toBeGreaterThan(20);
  for (const { random, own, share, direction, heading, lean, orientation, ...wanted } of samples.shapes) {
    // Single precision has four digits of the last of these numbers.
    expectNear(shader.ownNumbers(random), own, 3e-4);
    expectNear([shader.presence(share, own[2]!)], wanted.presence, 5e-4);
    expectNear([shader.unfolding(share, own[1]!)], wanted.unfolding, 2e-5);
    expectNear(shader.bending(random, own[3]!), wanted.bending, 5e-4);
    expectNear(shader.pointing(direction, heading, [0, 0, 0], lean, orientation), wanted.pointing, 2e-5);
  }
});

it("LF6: leaves are divided into the blades of exports", () => {
  const { bladeOf } = shaderFunctions<BladeFunctions>(LEAF_SHAPE, ["bladeOf"]);
  expect(samples.blades.length).toBeGreaterThan(20);
  for (const { direction, normal, random, count, number, bend, ...wanted } of samples.blades) {
    const found = bladeOf(direction, normal, random, count, number, bend);
    expectNear(found.base, wanted.base, 2e-4);
    expectNear(found.direction, wanted.way, 2e-4);
    expectNear(found.normal, wanted.up, 2e-4);
    expectNear([found.size, found.own], [wanted.size[0]!, wanted.own[0]!], 2e-4);
  }
});
