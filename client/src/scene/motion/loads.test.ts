import { describe, expect, it } from "vitest";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { Answers } from "./answers";
import { jointsOf } from "./joints";
import { loaded, loadsOf } from "./loads";
import { motionRows } from "./motion-rows";
import { hingesOf, NODE, nodeAt, pose, STAND } from "./pose";
import { RIDE } from "./rides";
import { Sway } from "./sway";
import { LIVE_PERIOD, windOf } from "./wind";

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
    expect(size(loads.rain)).toBeGreaterThan(0);
    expect(size(loads.snow)).toBeGreaterThan(size(without.snow));
  });
});

describe.each(SWAYING_TREES)("snow on $name", (tree) => {
  it("lets it hang lower, hanging shoots as well as level limbs", () => {
    const rows = motionRows(tableOfSwaying(tree));
    const grown = jointsOf(rows, tree, tree.suppleness);
    const { joints, wood } = grown;
    const sag = loaded(loadsOf(grown, rows, tree), { sag: 0, snow: 0.15, rain: 0 })!;
    const calm = windOf({ velocity: [0, 0, 0], turbulence: 0, seed: 1 }, LIVE_PERIOD);
    const even = new Float64Array(joints.count).fill(1);
    const bends = new Float64Array(3 * joints.count);
    new Sway(new Answers(joints, calm, even, { damping: 1, sag })).bends(0, bends);
    const stands = new Float64Array(STAND * joints.count);
    pose(hingesOf(joints, wood), bends, stands);
    const node = new Float64Array(NODE);
    let [fallen, risen, furthest] = [0, 0, 0];
    for (let row = 0; row < wood.parent.length; row += 1) {
      if (joints.rides[RIDE * row]! < 0) continue;
      nodeAt(stands, joints.rides, wood.place, row, node);
      const fell = wood.place[3 * row + 1]! - node[1]!;
      fallen += fell;
      risen = Math.max(risen, -fell);
      furthest = Math.max(furthest, fell);
    }
    expect(fallen).toBeGreaterThan(0);
    expect(risen, "nothing springs up").toBeLessThan(0.25 * furthest);
  });
});
