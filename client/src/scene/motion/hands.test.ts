import { describe, expect, it } from "vitest";
import { SMALL, tableOf } from "../../../test/small-tree";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { Answers } from "./answers";
import { Calm, RESTS, RETURNS } from "./calm";
import { ELSEWHERE } from "./hand";
import { Hands, jointsUnder, pluckedAnew } from "./hands";
import { JointWork } from "./joint-work";
import { NONE } from "./limbs";
import { motionRows } from "./motion-rows";
import { ROW_NUMBERS } from "./moving";
import { JOINT } from "./rides";
import { Riding } from "./riding";
import { Sway } from "./sway";
import { LIVE_PERIOD, windOf } from "./wind";

const FIRST = Int32Array.of(3, 8, 20);
const PARENT = Int32Array.of(NONE, 0, 1);

describe("how much of its sway a joint shows", () => {
  it("is none a quarter of a second after a hand has come, and all of it 1.2 s after that has gone", () => {
    const calm = new Calm(FIRST, PARENT);
    expect(calm.look(0)).toEqual({ calms: false, changes: false });
    calm.aim((joint) => [0, 0.25, 1][joint]!, 1000);
    const at = (now: number) => [0, 1, 2].map((joint) => calm.at(joint, now));
    expect(at(1000)).toEqual([1, 1, 1]);
    expect(at(1000 + RESTS / 2)).toEqual([0.5, 0.625, 1]);
    expect(at(1000 + RESTS)).toEqual([0, 0.25, 1]);
    expect(calm.look(1000 + RESTS)).toEqual({ calms: true, changes: false });
    calm.aim(() => 1, 5000);
    expect(at(5000)).toEqual([0, 0.25, 1]);
    expect(at(5000 + RETURNS / 2)).toEqual([0.5, 0.625, 1]);
    expect(calm.look(5000 + RETURNS - 1).changes).toBe(true);
    expect(at(5000 + RETURNS)).toEqual([1, 1, 1]);
    expect(calm.look(5000 + RETURNS)).toEqual({ calms: false, changes: false });
    expect([250, 1200]).toEqual([RESTS, RETURNS]);
  });

  it("goes on from where it is when a hand comes back, and stays within its bounds where the clock jumps", () => {
    const calm = new Calm(FIRST, PARENT);
    calm.aim(() => 0, 0);
    calm.aim(() => 1, RESTS / 2);
    expect(calm.at(0, RESTS / 2)).toBe(0.5);
    calm.aim(() => 1, RESTS / 2 + 300);
    for (const now of [-1e12, 0, 1e12]) {
      expect(calm.at(0, now)).toBeGreaterThanOrEqual(0.5);
      expect(calm.at(0, now)).toBeLessThanOrEqual(1);
    }
  });

  it("is the same for joints that were made anew, and for a new one that of what bears it", () => {
    const calm = new Calm(FIRST, PARENT);
    calm.aim((joint) => (joint === 1 ? 0 : 1), 0);
    const next = calm.carried(Int32Array.of(3, 8, 11, 20), Int32Array.of(NONE, 0, 1, 1));
    const shares = [0, 1, 2, 3].map((joint) => next.at(joint, 100));
    expect(shares).toEqual([1, calm.at(1, 100), calm.at(1, 100), 1]);
  });
});

describe("joints under a hand", () => {
  const table = tableOf(SMALL);
  // A joint each for the trunk, the limb to the right, the twig on it, and the twig to the left.
  const first = Int32Array.of(1, 6, 10, 12);
  const parent = Int32Array.of(NONE, 0, 1, 0);
  const rows = new Float32Array(ROW_NUMBERS * table.rows);
  for (const [row, joint] of [NONE, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 3, 3].entries()) {
    rows[ROW_NUMBERS * row + JOINT] = joint;
  }
  const under = (...at: number[]) => {
    const hinges = { count: 4, parent, numbers: new Float64Array(0) };
    return [...jointsUnder(at, table, { rows, count: table.rows }, { first, hinges })];
  };

  it("are those of its limb, of what bears that, and of all that it bears", () => {
    expect(under(9)).toEqual([1, 1, 1, 0]);
    expect(under(11)).toEqual([1, 1, 1, 0]);
    expect(under(13)).toEqual([1, 0, 0, 1]);
    expect(under(4)).toEqual([1, 1, 1, 1]);
    expect(under(11, 13)).toEqual([1, 1, 1, 1]);
  });

  it("are none where it lies on no branch, or on one that is not there", () => {
    expect(under()).toEqual([0, 0, 0, 0]);
    expect(under(-1, 99)).toEqual([0, 0, 0, 0]);
  });
});

describe("hands at a swaying tree", () => {
  const tree = SWAYING_TREES[1]!;
  const table = tableOfSwaying(tree);
  const order = (rows = motionRows(table)) => ({
    grown: { rows, scale: tree, suppleness: tree.suppleness },
    along: [1, 0, 0] as const,
    obstacles: { standing: [], meshes: [] },
  });
  const { moving, exposure } = new JointWork().make(order());
  const joints = moving!.joints.count;
  const wind = windOf({ velocity: [9, 0, 0], turbulence: 0.7, seed: 7 }, LIVE_PERIOD);

  function setUp() {
    const { parent, quantised } = motionRows(table);
    const riding = new Riding(moving!, parent, quantised);
    const sway = new Sway(new Answers(moving!.joints, wind, exposure));
    const hands = new Hands();
    hands.adopt(moving!, null, { table, riding }, table.radiusCode);
    /** How all joints are turned at a time in seconds, the wind's own and that of frames. */
    const at = (time: number) => {
      const [bends, exposed] = [new Float64Array(3 * joints), exposure.slice()];
      sway.bends(time, bends);
      const free = bends.slice();
      const changes = hands.apply(1000 * time, time, { table, riding, moving: moving!, sway }, bends, exposed);
      return { bends, free, exposed, changes };
    };
    return { hands, riding, sway, at };
  }

  const size = (bends: Float64Array, joint: number) => Math.hypot(...bends.subarray(3 * joint, 3 * joint + 3));
  /** The outermost row of the joint that bears another and sways most. */
  const limb = Array.from({ length: joints }, (_, joint) => joint).find(
    (joint) => moving!.hinges.parent[joint] !== NONE && size(setUp().at(20).bends, joint) > 0.01,
  )!;
  const row = moving!.first[limb]!;

  it("the limb under one rests after 250 ms, others keep a quarter, and all sway again", () => {
    const { hands, riding, at } = setUp();
    expect(at(20).bends).toEqual(at(20).free);
    hands.touch({ rows: [row], elsewhere: ELSEWHERE });
    expect(at(20).changes).toBe(true);
    const { bends, free, exposed, changes } = at(20.25);
    expect(changes).toBe(false);
    const under = jointsUnder([row], table, riding, moving!);
    expect(under[limb]).toBe(1);
    expect([...under].some((each) => each === 0)).toBe(true);
    for (const [joint, is] of under.entries()) {
      const share = is === 1 ? 0 : ELSEWHERE;
      expect(size(bends, joint)).toBeCloseTo(share * size(free, joint), 9);
      expect(exposed[joint]).toBeCloseTo(share * exposure[joint]!, 9);
    }
    hands.touch(null);
    at(30);
    const half = at(30.6);
    expect(size(half.bends, limb)).toBeCloseTo(0.5 * size(half.free, limb), 9);
    const later = at(31.2);
    expect(later.bends).toEqual(later.free);
    expect(at(31.3).changes).toBe(false);
  });

  it("what was bent starts from where it is, without speed, and comes to swing as if nothing had been", () => {
    const { hands, sway, at } = setUp();
    hands.touch({ rows: [row], elsewhere: ELSEWHERE });
    at(20);
    hands.release([row]);
    expect(size(at(21).bends, limb), "it is still held").toBe(0);
    hands.touch(null);
    expect(size(at(22).bends, limb), "it starts from rest").toBeLessThan(1e-9);
    const [soon, later] = [0.01, 0.02].map((gone) => size(at(22 + gone).bends, limb));
    expect(soon!, "and without speed").toBeLessThan(0.3 * later!);
    expect(sway.plucked.some(({ joint }) => joint === limb)).toBe(true);
    const undisturbed = setUp();
    const apart = (time: number) => {
      const [one, other] = [at(time).bends, undisturbed.at(time).bends];
      return Math.hypot(...[0, 1, 2].map((a) => one[3 * limb + a]! - other[3 * limb + a]!));
    };
    const lasts = 7 / (moving!.joints.damping[limb]! * 2 * Math.PI * moving!.joints.frequency[limb]!);
    expect(apart(22)).toBeGreaterThan(0.005);
    expect(apart(22 + lasts)).toBeLessThan(2e-3 * Math.max(1, apart(22) / 0.1));
    // Half a period later it has swung beyond.
    const half = 0.5 / moving!.joints.frequency[limb]!;
    expect(apart(22 + half)).toBeGreaterThan(0.3 * apart(22));
  });

  it("what bore a branch that is cut off springs up from where it is, swings, and rests", () => {
    const calm = windOf({ velocity: [0, 0, 0], turbulence: 0, seed: 7 }, LIVE_PERIOD);
    const { hands, riding, sway } = setUp();
    const rows = motionRows(table);
    const dead = new Set([row]);
    for (let each = row + 1; each < table.rows; each += 1) if (dead.has(rows.parent[each]!)) dead.add(each);
    for (const each of dead) [rows.radiusCode[each], rows.leaves[each]] = [0, 0];
    hands.cut([row]);
    expect(hands.waits).toBe(true);
    // What is made of rows that still have it changes nothing.
    hands.adopt(moving!, moving!, { table, riding }, table.radiusCode);
    expect(hands.waits).toBe(true);
    const without = new JointWork().make(order(rows));
    const next = new Riding(without.moving!, rows.parent, rows.quantised);
    hands.adopt(without.moving!, moving!, { table, riding: next }, rows.radiusCode);
    expect(hands.waits).toBe(false);
    const still = new Sway(new Answers(without.moving!.joints, calm, without.exposure));
    const at = (time: number) => {
      const bends = new Float64Array(3 * without.moving!.joints.count);
      still.bends(time, bends);
      const swaying = { table, riding: next, moving: without.moving!, sway: still };
      hands.apply(1000 * time, time, swaying, bends, without.exposure.slice());
      still.bends(time, bends);
      return bends;
    };
    expect(
      at(5).every((bend) => bend === 0),
      "it starts where it is",
    ).toBe(true);
    expect(still.plucked.length).toBeGreaterThan(0);
    const { joint, speed } = still.plucked[0]!;
    const bearer = moving!.first.indexOf(without.moving!.first[joint]!);
    const weight = [0, 1, 2].map((a) => moving!.loads.sag[3 * bearer + a]! - without.moving!.loads.sag[3 * joint + a]!);
    const along = weight.reduce((sum, each, a) => sum + each * speed![a]!, 0);
    expect(along, "against what the weight did").toBeLessThan(0);
    const swung = size(at(5 + 0.25 / without.moving!.joints.frequency[joint]!), joint);
    expect(swung).toBeGreaterThan(0.3 * Math.min(0.25, Math.hypot(...weight)));
    still.forget(5 + 600);
    expect(still.plucked).toEqual([]);
    expect(sway.plucked).toEqual([]);
  });

  it("plucks go on in joints that were made anew, and end with those that are gone", () => {
    const pluck = { joint: 2, at: 3, bend: [0.1, 0, 0] as const };
    expect(pluckedAnew([pluck], Int32Array.of(4, 9, 12), Int32Array.of(4, 12))).toEqual([{ ...pluck, joint: 1 }]);
    expect(pluckedAnew([pluck], Int32Array.of(4, 9, 12), Int32Array.of(4, 9))).toEqual([]);
  });
});
