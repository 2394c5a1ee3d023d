import { describe, expect, it } from "vitest";
import { SAMPLED_JOINTS, SWAYING_TREES, type SwayingTree, tableOfSwaying } from "../../../test/swaying-trees";
import { alongOf, velocityOf } from "./air-settings";
import { Answers } from "./answers";
import { behindCrowns, exposureOf } from "./exposure";
import { jointsOf } from "./joints";
import { loaded, loadsOf } from "./loads";
import { motionRows } from "./motion-rows";
import { ObstaclePost, ObstaclesReceived } from "./obstacle-post";
import { hingesOf, NODE, nodeAt, pose, STAND } from "./pose";
import { FIRST, RIDE, SECOND, WEIGHT } from "./rides";
import { sharesOf } from "./shelter";
import { Sway } from "./sway";
import { windOf } from "./wind";

/** Sines and powers may differ in a last bit from the server's, everything else is equal to the bit. */
const NEAR = 1e-11;

function grownOf(tree: SwayingTree) {
  return jointsOf(motionRows(tableOfSwaying(tree)), tree, tree.suppleness);
}

/** Its obstacles, as a page draws them and a worker gets them. */
function solidsOf({ obstacles, internodeLength }: SwayingTree) {
  const mesh = {
    positions: Float32Array.from(obstacles.positions),
    triangles: Uint32Array.from(obstacles.triangles),
  };
  const drawn = obstacles.standing.map(({ shape, pose }, id) => ({
    id,
    shape,
    pose,
    ...(shape.kind === "mesh" ? { mesh } : {}),
  }));
  return new ObstaclesReceived().receive(new ObstaclePost().post(drawn), internodeLength);
}

/** Fails where two lists of numbers differ by more than a share of the largest of them. */
function expectNear(found: ArrayLike<number>, expected: ArrayLike<number>, what: string, near = NEAR): void {
  const size = Array.from(expected).reduce((most, each) => Math.max(most, Math.abs(each)), 1e-3);
  expect(found.length, what).toBe(expected.length);
  for (let i = 0; i < expected.length; i += 1) {
    const gap = Math.abs(found[i]! - expected[i]!);
    if (!(gap <= near * size)) throw new Error(`${what}, number ${i}: ${found[i]} instead of ${expected[i]}`);
  }
}

const part = (of: Float64Array, each: number, at: number) => of.subarray(each * at, each * at + each);

describe.each(SWAYING_TREES)("$name, as the server has it", (tree) => {
  const { limbs, wood, joints } = grownOf(tree);
  const wind = windOf(tree.wind, tree.wind.period);
  const along = alongOf(tree.blows);
  const shares = behindCrowns(wood, along);
  const exposure = exposureOf(joints, wood, shares);

  it("has the same limbs", () => {
    const { onward } = motionRows(tableOfSwaying(tree));
    for (const [row, next] of tree.onward) expect(onward[row]).toBe(next);
    expect(tree.limbs.length).toBe(limbs.count);
    for (const [limb, [first, node]] of tree.limbs.entries()) {
      expect([limbs.first[limb], limbs.node[limb]]).toEqual([first, node]);
    }
  });

  it("has the same joints to the bit", () => {
    expect(joints.count).toBe(tree.joints.length);
    for (const [joint, sample] of tree.joints.entries()) {
      const found = {
        first: joints.first[joint],
        node: joints.node[joint],
        parent: joints.parent[joint],
        level: joints.level[joint],
        frequency: joints.frequency[joint],
        damping: joints.damping[joint],
        drag: joints.drag[joint],
        softness: joints.softness[joint],
        compliance: [...part(joints.compliance, 9, joint)].map((each) => each + 0),
        centre: [...part(joints.centre, 3, joint)],
        area: joints.area[joint],
        lowest: joints.lowest[joint],
      };
      expect(found).toEqual({ ...sample, compliance: sample.compliance.map((each) => each + 0) });
    }
  });

  it("has rows that ride alike to the bit", () => {
    expect([...tree.riders.keys()].map((row) => joints.rides[RIDE * row])).toEqual(tree.riders);
    for (const [row, weight, first, second] of tree.rides) {
      const ride = part(joints.rides, RIDE, row);
      expect(ride[WEIGHT]).toBe(weight);
      expectNear(ride.subarray(FIRST, SECOND), first, `first of row ${row}`, 0);
      expectNear(ride.subarray(SECOND), second, `second of row ${row}`, 0);
    }
  });

  it("stands in the same wind", () => {
    for (const sample of [tree.wind, tree.change.wind]) {
      const { axes, lines } = windOf(sample, sample.period);
      expectNear(axes.flat(), sample.axes.flat(), "axes");
      expect(lines.map(({ harmonic, direction }) => [harmonic, direction])).toEqual(
        sample.lines.map(({ harmonic, direction }) => [harmonic, direction]),
      );
      for (const [k, line] of lines.entries()) {
        const { amplitude, phase, wave } = sample.lines[k]!;
        expectNear([line.amplitude, line.phase, ...line.wave], [amplitude, phase, ...wave], `line ${k}`);
      }
    }
  });

  it("is sheltered alike", () => {
    for (const [row, share] of tree.shares) expectNear([shares[row]!], [share], `row ${row}`);
    expectNear(exposure, tree.exposure, "exposure");
  });

  it("is sheltered from where the whole wind comes, rise included", () => {
    expectNear(velocityOf(tree.blows), tree.wind.velocity, "velocity");
    expectNear(along, tree.wind.axes[0]!, "along");
  });

  it("is sheltered alike by obstacles", () => {
    const solids = solidsOf(tree);
    expect(solids.length).toBe(tree.obstacles.standing.length);
    const lee = sharesOf(wood, along, solids);
    for (const [row, share] of tree.lee) expectNear([lee[row]!], [share], `row ${row}`);
    const inLee = exposureOf(joints, wood, lee);
    expectNear(inLee, tree.inLee, "exposure");
    const sheltered = inLee.filter((each, joint) => each < 0.98 * exposure[joint]!).length;
    expect(sheltered, "obstacles count").toBeGreaterThan(joints.count / 4);
  });

  it("bends alike under what lies on it", () => {
    const grown = { limbs, wood, joints };
    const loads = loadsOf(grown, motionRows(tableOfSwaying(tree)), tree);
    const sampled = (of: Float64Array) =>
      Array.from({ length: Math.ceil(joints.count / SAMPLED_JOINTS) }, (_, i) => [...part(of, 3, i * SAMPLED_JOINTS)]);
    for (const load of ["sag", "snow", "rain"] as const) {
      expectNear(sampled(loads[load]).flat(), tree.laden[load].flat(), load, 1e-9);
    }
    const temper = { damping: 1, sag: loaded(loads, tree.laden.loading) };
    const { mean } = new Answers(joints, wind, Float64Array.from(tree.inLee), temper);
    expectNear(sampled(mean).flat(), tree.laden.means.flat(), "means", 1e-9);
  });

  it("sways alike", () => {
    const answers = new Answers(joints, wind, exposure);
    for (const [i, sample] of tree.answers.entries()) {
      const joint = i * SAMPLED_JOINTS;
      expectNear(part(answers.mean, 3, joint), sample.mean, `mean of joint ${joint}`);
      expectNear(part(answers.swing, 9, joint), sample.swing, `swing of joint ${joint}`);
      expectNear([answers.damping[joint]!], [sample.damping], `damping of joint ${joint}`);
    }
    const sway = new Sway(answers);
    const weak = windOf(tree.change.wind, tree.change.wind.period);
    sway.change(new Answers(joints, weak, new Float64Array(joints.count).fill(1)), tree.change.at);
    sway.pluck(tree.pluck);
    const hinges = hingesOf(joints, wood);
    const bends = new Float64Array(3 * joints.count);
    const stands = new Float64Array(STAND * joints.count);
    const node = new Float64Array(NODE);
    for (const { time, bends: expected, nodes } of tree.stands) {
      sway.bends(time, bends);
      for (const [i, bend] of expected.entries()) {
        expectNear(part(bends, 3, i * SAMPLED_JOINTS), bend, `joint ${i * SAMPLED_JOINTS} at ${time} s`, 1e-9);
      }
      pose(hinges, bends, stands);
      for (const [row, place, turn] of nodes) {
        nodeAt(stands, joints.rides, wood.place, row, node);
        expectNear(node.subarray(0, 3), place, `row ${row} at ${time} s`, 1e-9);
        expectNear(node.subarray(3), turn, `turn of row ${row} at ${time} s`, 1e-9);
      }
    }
  });
});
