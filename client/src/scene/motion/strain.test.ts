import { describe, expect, it } from "vitest";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { MIN_RADIUS } from "../../wire/generated";
import { type AirSettings, CALM } from "./air-settings";
import { pressureOf } from "./answers";
import type { MotionRows } from "./limbs";
import { motionRows } from "./motion-rows";
import { breaking, STRENGTH, stressesOf } from "./strain";

const STORM: AirSettings = { ...CALM, speed: 18, turbulence: 0.8 };
const SNOWED_IN: AirSettings = { ...CALM, snow: 0.15 };

/** The same without all that stands above some rows, and those. */
function without(rows: MotionRows, cut: readonly number[]): MotionRows {
  const radiusCode = rows.radiusCode.slice();
  const leaves = rows.leaves.slice();
  const gone = new Set(cut);
  for (let row = 0; row < radiusCode.length; row += 1) {
    if (gone.has(rows.parent[row]!)) gone.add(row);
    if (gone.has(row)) [radiusCode[row], leaves[row]] = [0, 0];
  }
  return { ...rows, radiusCode, leaves };
}

describe.each(SWAYING_TREES)("what $name can stand", (tree) => {
  const rows = motionRows(tableOfSwaying(tree));
  const scale = { internodeLength: tree.internodeLength, leafSize: tree.leafSize };
  const stresses = (air: AirSettings, of = rows) => stressesOf(of, scale, air);
  const most = (air: AirSettings) => stresses(air).reduce((most, each) => Math.max(most, each), 0);

  it("is anything in a calm, more in a breeze than in a storm, and more in little snow than in much", () => {
    expect(most(CALM)).toBe(0);
    const winds = [3, 8, 18].map((speed) => most({ ...STORM, speed }));
    const snows = [0.1, 0.2, 0.4].map((snow) => most({ ...CALM, snow }));
    for (const [less, more, most] of [winds, snows] as [number, number, number][]) {
      expect(less).toBeGreaterThan(0);
      expect(more).toBeGreaterThan(less);
      expect(most).toBeGreaterThan(more);
    }
    expect(snows[1]! / snows[0]!).toBeCloseTo(2, 9);
    expect(breaking(stresses({ ...STORM, speed: 3 }))).toEqual([]);
  });

  it("is what is left once all that breaks under snow has fallen", () => {
    const fallen = without(rows, breaking(stresses(SNOWED_IN)));
    expect(breaking(stresses(SNOWED_IN, fallen))).toEqual([]);
  });
});

/** A pole of so many internodes of a metre that lies along z at a height, with radii of that code. */
function pole(count: number, height: number, code: number): MotionRows {
  const parent = Int32Array.from({ length: count + 1 }, (_, row) => row - 1);
  const quantised = new Int32Array(3 * (count + 1));
  for (let row = 0; row <= count; row += 1) quantised.set([0, 256 * height, 256 * row], 3 * row);
  const radiusCode = new Uint16Array(count + 1).fill(code, 1);
  const onward = Int32Array.from({ length: count + 1 }, (_, row) => (row < count ? row + 1 : -1));
  return { parent, onward, quantised, radiusCode, leaves: new Uint8Array(count + 1) };
}

describe("a pole that lies across the wind", () => {
  const code = 300;
  const radius = MIN_RADIUS * 1.010050167084168 ** (code - 1);
  const air: AirSettings = { ...CALM, speed: 12, direction: 0, turbulence: 0.4 };

  it("bears at its foot what theory has: 4 q L² / π r² under an even load", () => {
    const stresses = stressesOf(pole(8, 10, code), { internodeLength: 1, leafSize: 1 }, air);
    const [pressure] = pressureOf(12 * (1 + 3.5 * 0.5 * 0.4));
    const load = pressure * 2 * radius;
    expect(stresses[1]! / ((4 * load * 32) / (Math.PI * radius ** 3))).toBeCloseTo(1, 6);
    expect(stresses[8]! / ((4 * load * 0.5) / (Math.PI * radius ** 3))).toBeCloseTo(1, 6);
  });

  it("breaks at its foot where it is thin, and nowhere where it is thick", () => {
    const broken = (code: number) => {
      return breaking(stressesOf(pole(8, 10, code), { internodeLength: 1, leafSize: 1 }, air));
    };
    expect(broken(250)[0]).toBe(1);
    expect(broken(250)).not.toContain(8);
    expect(broken(500)).toEqual([]);
    expect(STRENGTH).toBe(40e6);
  });
});
