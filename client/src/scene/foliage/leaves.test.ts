import { readFileSync } from "node:fs";
import { expect, it } from "vitest";
import { shaderFunctions } from "../../../test/shader-functions";
import { LEAF_PLACE } from "../glsl/leaf";
import { leafHash } from "../leaf-hash";
import { leafAzimuth, leafRandom, shootOf } from "./leaves";
import { organAzimuth, organLength, organStance } from "./organs";

/** A leaf as the server places it. */
interface Placed {
  row: number;
  /** 0 for a leaf. */
  salt: number;
  k: number;
  count: number;
  from: number[];
  to: number[];
  base: number[];
  direction: number[];
  normal: number[];
  random: number;
}

interface PlaceFunctions {
  givenAt: unknown;
  leafAt(
    a: number[],
    b: number[],
    azimuth: number,
    share: number,
    stance: number,
  ): Pick<Placed, "base" | "direction" | "normal">;
}

const file = new URL("../../../../server/mesh/golden/leaves.json", import.meta.url);
const leaves: Placed[] = JSON.parse(readFileSync(file, "utf8"));

/** An organ as the server places it. */
interface PlacedOrgan extends Pick<Placed, "from" | "to" | "direction" | "normal"> {
  organ: number;
  length: number;
}

const organs: PlacedOrgan[] = JSON.parse(readFileSync(new URL("organs.json", file), "utf8"));

it("LF3: a leaf hashes in 32-bit arithmetic", () => {
  expect([0, 1, 16, 82, 1599998].map(leafHash)).toEqual([129708002, 2831084092, 980210444, 1877514304, 922964444]);
});

it("LF1, LF2, LF4: leaves are where the server has them", () => {
  const { leafAt } = shaderFunctions<PlaceFunctions>(LEAF_PLACE, ["leafAt"]);
  expect(leaves.length).toBeGreaterThan(50);
  for (const { row, salt, k, count, from, to, random, ...wanted } of leaves) {
    expect(leafRandom(row, k, salt)).toBeCloseTo(random, 6);
    const azimuth = leafAzimuth(row, k, count, salt);
    expect(azimuth).toBeLessThan(2 * Math.PI);
    const found = leafAt(from, to, azimuth, (k + 1) / count, -1);
    for (const name of ["base", "direction", "normal"] as const) {
      for (let i = 0; i < 3; i += 1) expect(Math.abs(found[name][i]! - wanted[name][i]!)).toBeLessThan(1e-4);
    }
  }
});

it("LF5: organs stand as the server has them", () => {
  const { leafAt } = shaderFunctions<PlaceFunctions>(LEAF_PLACE, ["leafAt", "givenAt"]);
  expect(organs.length).toBeGreaterThan(20);
  for (const { organ, from, to, length, ...wanted } of organs) {
    const found = leafAt(from, to, organAzimuth(organ), 1, organStance(organ));
    expect(found.base).toEqual(to);
    expect(Math.abs(organLength(organ) - length)).toBeLessThan(1e-5 * (1 + length));
    for (const name of ["direction", "normal"] as const) {
      for (let i = 0; i < 3; i += 1) expect(Math.abs(found[name][i]! - wanted[name][i]!)).toBeLessThan(1e-4);
    }
  }
});

it("what grew of an axis in one step is a shoot", () => {
  const table = {
    parent: new Int32Array([-1, 0, 1, 2, 3, 2]),
    startsAxis: new Uint8Array([1, 0, 0, 0, 0, 1]),
    born: new Uint32Array([0, 1, 1, 2, 2, 2]),
  };
  expect([1, 2, 3, 4, 5].map((row) => shootOf(table, row))).toEqual([1, 1, 3, 3, 5]);
});
