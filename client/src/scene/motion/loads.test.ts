import { describe, expect, it } from "vitest";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { jointsOf } from "./joints";
import { loaded, loadsOf } from "./loads";
import { motionRows } from "./motion-rows";

describe.each(SWAYING_TREES)("what lies on $name", (tree) => {
  const rows = motionRows(tableOfSwaying(tree));
  const scale = { internodeLength: tree.internodeLength, leafSize: tree.leafSize };
  const grown = jointsOf(rows, scale, tree.suppleness);
  const loads = loadsOf(grown, rows, scale);
  const size = (turns: Float64Array) => Math.sqrt(turns.reduce((sum, each) => sum + each * each, 0));

  it("bends it by so much as there is, and nothing does nothing", () => {
    expect(loaded(loads, { sag: 0, snow: 0, rain: 0 })).toBe(null);
    const once = loaded(loads, { sag: 0, snow: 0.1, rain: 0 })!;
    const twice = loaded(loads, { sag: 0, snow: 0.2, rain: 0 })!;
    expect(size(twice)).toBeCloseTo(2 * size(once), 9);
    expect(twice.every(Number.isFinite)).toBe(true);
    const both = loaded(loads, { sag: 0.5, snow: 0.2, rain: 0 })!;
    expect(both[0]).toBeCloseTo(0.5 * loads.sag[0]! + 0.2 * loads.snow[0]!, 12);
  });

  it("rests on leaves as much as on wood, and wood without leaves holds no rain", () => {
    const bare = { ...rows, leaves: new Uint8Array(rows.leaves.length) };
    const without = loadsOf(jointsOf(bare, scale, tree.suppleness), bare, scale);
    expect(size(without.rain)).toBe(0);
    const hasLeaves = rows.leaves.some((count) => count > 0);
    if (hasLeaves) {
      expect(size(loads.rain)).toBeGreaterThan(0);
      expect(size(loads.snow)).toBeGreaterThan(size(without.snow));
    }
  });
});
