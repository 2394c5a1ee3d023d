import { describe, expect, it } from "vitest";
import { SMALL, type Twig, tableOf } from "../../../test/small-tree";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { Answers } from "./answers";
import { behindCrowns, exposureOf } from "./exposure";
import { type Grown, jointsOf } from "./joints";
import { motionRows } from "./motion-rows";
import { hingesOf, NODE, nodeAt, pose, STAND } from "./pose";
import { FADE, Sway } from "./sway";
import { windOf } from "./wind";

const SCALE = { internodeLength: 0.1, leafSize: 1 };
const WEATHER = { velocity: [5, 0, 3], turbulence: 0.7, seed: 3 } as const;

const even = ({ joints }: Grown) => new Float64Array(joints.count).fill(1);
const swayOf = (grown: Grown, period = 600, weather: Parameters<typeof windOf>[0] = WEATHER) =>
  new Sway(new Answers(grown.joints, windOf(weather, period), even(grown)));

function bendsAt(grown: Grown, sway: Sway, time: number): Float64Array {
  const bends = new Float64Array(3 * grown.joints.count);
  sway.bends(time, bends);
  return bends;
}

/** Where all nodes are. */
function nodesAt({ joints, wood }: Grown, bends: Float64Array): Float64Array {
  const stands = new Float64Array(STAND * joints.count);
  pose(hingesOf(joints, wood), bends, stands);
  const node = new Float64Array(NODE);
  const places = new Float64Array(wood.place.length);
  for (let row = 0; row < wood.parent.length; row += 1) {
    nodeAt(stands, joints.rides, wood.place, row, node);
    places.set(node.subarray(0, 3), 3 * row);
  }
  return places;
}

const willow = jointsOf(motionRows(tableOfSwaying(SWAYING_TREES[1]!)), SCALE, 2.5);

describe("a swaying tree", () => {
  it("stands as it grew where no wind blows", () => {
    const calm = bendsAt(willow, swayOf(willow, 600, { velocity: [0, 0, 0], turbulence: 1, seed: 1 }), 12);
    expect(calm.every((bend) => bend === 0)).toBe(true);
    expect(nodesAt(willow, calm)).toEqual(willow.wood.place);
  });

  it("comes round to the bit after a period", () => {
    const sway = swayOf(willow, 8);
    expect(bendsAt(willow, sway, 8 + 1.25)).toEqual(bendsAt(willow, sway, 1.25));
    expect(bendsAt(willow, sway, 800)).toEqual(bendsAt(willow, sway, 0));
    expect(bendsAt(willow, sway, 4)).not.toEqual(bendsAt(willow, sway, 0));
  });

  it("keeps its internodes as long as they are, and stays above the ground", () => {
    const { wood } = willow;
    const storm = { velocity: [-18, 0, 0], turbulence: 1, seed: 5 } as const;
    const sway = swayOf(willow, 600, storm);
    let [sum, count, worst] = [0, 0, 0];
    for (let time = 0; time < 40; time += 1.7) {
      const places = nodesAt(willow, bendsAt(willow, sway, time));
      for (let row = 0; row < wood.parent.length; row += 1) {
        expect(places[3 * row + 1]).toBeGreaterThanOrEqual(Math.min(wood.place[3 * row + 1]!, 0));
        const parent = wood.parent[row]!;
        const rest = wood.length[row]!;
        // What lies on the ground is pressed flat.
        if (rest === 0 || parent < 0 || places[3 * row + 1]! <= 1e-9) continue;
        const way = [0, 1, 2].map((a) => places[3 * row + a]! - places[3 * parent + a]!);
        const stretch = Math.abs(Math.hypot(...way) / rest - 1);
        worst = Math.max(worst, stretch);
        sum += stretch;
        count += 1;
      }
    }
    expect(sum / count).toBeLessThan(0.005);
    expect(worst).toBeLessThan(0.06);
  });

  it.each(SWAYING_TREES)("moves as far as one sees trees move: $name", (tree) => {
    const grown = jointsOf(motionRows(tableOfSwaying(tree)), tree, 1);
    const { wood, joints } = grown;
    const exposure = exposureOf(joints, wood, behindCrowns(wood, [1, 0, 0]));
    const height = wood.place.reduce((most, each, at) => (at % 3 === 1 ? Math.max(most, each) : most), 0);
    /** How far nodes go within eight seconds from one place to another, as a share of the tree's height, in ascending order. */
    const travels = (speed: number, turbulence: number) => {
      const wind = windOf({ velocity: [speed, 0, 0], turbulence, seed: 7 }, 8);
      const sway = new Sway(new Answers(joints, wind, exposure));
      const looks = Array.from({ length: 80 }, (_, at) => nodesAt(grown, bendsAt(grown, sway, 0.1 * at)));
      const reach = (row: number) =>
        Math.hypot(
          ...[0, 1, 2].map((a) => {
            const ways = looks.map((places) => places[3 * row + a]!);
            return Math.max(...ways) - Math.min(...ways);
          }),
        );
      const wooden = Array.from(wood.length.keys()).filter((row) => wood.length[row]! > 0);
      return wooden.map((row) => reach(row) / height).sort((a, b) => a - b);
    };
    const quantile = (sorted: number[], share: number) => sorted[Math.floor(share * (sorted.length - 1))]!;
    // In a breeze leaves and twigs are seen to move, and hardly anything else; in a storm whole limbs.
    const breeze = travels(3, 0.6);
    expect(quantile(breeze, 0.5)).toBeLessThan(0.002);
    expect(quantile(breeze, 0.9)).toBeLessThan(0.007);
    expect(quantile(breeze, 1)).toBeLessThan(0.03);
    const storm = travels(18, 0.8);
    expect(quantile(storm, 0.5)).toBeGreaterThan(0.02);
    expect(quantile(storm, 1)).toBeLessThan(0.4);
  });

  it("passes from one wind to another without a jump", () => {
    const sway = swayOf(willow);
    const other = windOf({ velocity: [-9, 0, 0], turbulence: 0.5, seed: 3 }, 600);
    sway.change(new Answers(willow.joints, other, even(willow)), 10);
    const gapAfter = (time: number, step: number) => {
      const before = bendsAt(willow, sway, time);
      return bendsAt(willow, sway, time + step).reduce(
        (most, bend, i) => Math.max(most, Math.abs(bend - before[i]!)),
        0,
      );
    };
    for (const time of [10, 10.7, 10 + FADE]) expect(gapAfter(time - 1e-6, 2e-6)).toBeLessThan(1e-4);
  });

  it("goes on where the clock jumps, backwards and forwards", () => {
    const sway = swayOf(willow);
    const fresh = () => new Answers(willow.joints, windOf(WEATHER, 600), even(willow));
    sway.change(fresh(), 1000);
    sway.forget(1002);
    sway.change(fresh(), 5);
    for (const time of [-1e9, 0, 4, 5.5, 1e9]) {
      expect(bendsAt(willow, sway, time).every(Number.isFinite)).toBe(true);
    }
  });

  it("forgets a pluck once it is over", () => {
    const calm = swayOf(willow, 600, { velocity: [0, 0, 0], turbulence: 0, seed: 1 });
    calm.pluck({ joint: 0, at: 0, bend: [0.2, 0, 0] });
    expect(bendsAt(willow, calm, 0.01)[0]).toBeGreaterThan(0.1);
    calm.forget(600);
    expect(bendsAt(willow, calm, 0.01)[0]).toBe(0);
  });
});

describe("rows that are hardly a tree", () => {
  const grownOf = (twigs: readonly Twig[]) => jointsOf(motionRows(tableOf(twigs)), SCALE, 1);

  it.each([
    ["nothing", []],
    ["a seed", SMALL.slice(0, 1)],
    ["one metamer", SMALL.slice(0, 2)],
    ["only dead wood", SMALL.map((twig) => ({ ...twig, dead: true }))],
    ["wood without length", SMALL.map((twig) => ({ ...twig, at: [0, 0, 0] as const }))],
  ])("%s moves by finite numbers", (_, twigs) => {
    const grown = grownOf(twigs);
    const exposure = exposureOf(grown.joints, grown.wood, behindCrowns(grown.wood, [1, 0, 0]));
    const sway = new Sway(new Answers(grown.joints, windOf(WEATHER, 600), exposure));
    const places = nodesAt(grown, bendsAt(grown, sway, 3));
    expect(places.every(Number.isFinite)).toBe(true);
  });

  it("a trunk bends to lee", () => {
    const twigs = SMALL.slice(0, 6).map((twig) => ({ ...twig, radius: 0.02 }));
    const grown = grownOf(twigs);
    expect(grown.joints.count).toBe(1);
    const steady = swayOf(grown, 600, { velocity: [8, 0, 0], turbulence: 0, seed: 1 });
    const places = nodesAt(grown, bendsAt(grown, steady, 0));
    expect(places[3 * 5]! - grown.wood.place[3 * 5]!).toBeGreaterThan(0);
  });
});
