import { describe, expect, it } from "vitest";
import { randoms } from "../../../../test/randoms";
import { SWAYING_TREES, tableOfSwaying } from "../../../../test/swaying-trees";
import { Answers } from "../../../scene/motion/answers";
import { jointsOf } from "../../../scene/motion/joints";
import { motionRows } from "../../../scene/motion/motion-rows";
import { hingesOf, NODE, nodeAt, pose, STAND } from "../../../scene/motion/pose";
import { SharedClock } from "../../../scene/motion/shared-clock";
import { Sway } from "../../../scene/motion/sway";
import { LIVE_PERIOD, windOf } from "../../../scene/motion/wind";
import { ServerTime } from "../../connection/server-time";

const FRAME = 16;
const tree = SWAYING_TREES[1]!;
const { joints, wood } = jointsOf(motionRows(tableOfSwaying(tree)), tree, tree.suppleness);
const wind = windOf({ velocity: [8, 0, 2], turbulence: 0.7, seed: 7 }, LIVE_PERIOD);
const sway = new Sway(new Answers(joints, wind, new Float64Array(joints.count).fill(1)));
const hinges = hingesOf(joints, wood);

/** Where the tips of limbs are at a time in seconds, in metres. */
function tipsAt(time: number): Float64Array {
  const bends = new Float64Array(3 * joints.count);
  const stands = new Float64Array(STAND * joints.count);
  sway.bends(time, bends);
  pose(hinges, bends, stands);
  const node = new Float64Array(NODE);
  const tips = new Float64Array(3 * joints.count);
  for (let joint = 0; joint < joints.count; joint += 1) {
    nodeAt(stands, joints.rides, wood.place, joints.lowest[joint]!, node);
    tips.set(node.subarray(0, 3), 3 * joint);
  }
  return tips;
}

interface Device {
  /** Milliseconds by which its clock is ahead, and parts of a million by which it gains. */
  readonly ahead: number;
  readonly gains: number;
  /** When it joins, and the shortest way to the server and back, in milliseconds. */
  readonly joins: number;
  readonly way: number;
  /** The server is out of reach for it from then to then. */
  readonly gone?: readonly [number, number];
}

/** A page whose messages take time, and the same each way. */
function pageOf({ ahead, gains, joins, way, gone }: Device, seed: number) {
  const random = randoms(seed);
  const pongs: { readonly due: number; readonly nonce: number; readonly at: number }[] = [];
  let now = joins;
  const own = () => now * (1 + gains / 1e6) + ahead;
  const server = new ServerTime(
    (nonce) => {
      if (gone && now >= gone[0] && now < gone[1]) return false;
      const each = (way + 80 * random() * random()) / 2;
      pongs.push({ due: now + 2 * each, nonce, at: now + each });
      return true;
    },
    { now: own },
  );
  const clock = new SharedClock(
    () => own() / 1000,
    () => server.read() / 1000,
  );
  return (time: number): number => {
    now = time;
    for (const pong of pongs.splice(0)) {
      if (pong.due <= now) server.heard(pong.nonce, pong.at);
      else pongs.push(pong);
    }
    return clock.read().time;
  };
}

const DEVICES: readonly Device[] = [
  { ahead: 30, gains: 40, joins: 0, way: 8 },
  { ahead: -30, gains: -40, joins: 7_000, way: 60 },
  { ahead: 1_700_000, gains: 10, joins: 21_000, way: 25, gone: [40_000, 52_000] },
];

describe("pages whose clocks differ", () => {
  it("see one gust: tips stand within 2 % of their amplitude, whoever came late or lost the line", () => {
    const pages = DEVICES.map((device, i) => ({ device, at: pageOf(device, i + 1) }));
    const looks: Float64Array[][] = [];
    for (let time = 0; time <= 90_000; time += FRAME) {
      const present = pages.filter(({ device }) => time >= device.joins);
      const times = present.map(({ at }) => at(time));
      // Ten seconds after the last has come or come back.
      const settled = time > 62_000 || (time > 31_000 && time < 40_000);
      if (settled && time % (25 * FRAME) === 0) looks.push(times.map(tipsAt));
    }
    expect(looks.length).toBeGreaterThan(60);
    const mean = tipsAt(0).map((_, i) => looks.reduce((sum, [first]) => sum + first![i]!, 0) / looks.length);
    const rms = (apart: (look: Float64Array[], i: number) => number) =>
      Math.sqrt(
        looks.reduce((sum, look) => sum + mean.reduce((sum, _, i) => sum + apart(look, i) ** 2, 0), 0) /
          (looks.length * mean.length),
      );
    const amplitude = rms(([first], i) => first![i]! - mean[i]!);
    expect(amplitude, "the wind moves them").toBeGreaterThan(0.001);
    for (const other of [1, 2]) {
      const apart = rms((look, i) => look[other]![i]! - look[0]![i]!);
      expect(apart / amplitude, `device ${other}`).toBeLessThan(0.02);
    }
  });
});
