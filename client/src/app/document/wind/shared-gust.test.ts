import { describe, expect, it } from "vitest";
import { randoms } from "../../../../test/randoms";
import { SWAYING_TREES, tableOfSwaying } from "../../../../test/swaying-trees";
import { type AirSettings, CALM, velocityOf } from "../../../scene/motion/air-settings";
import { Answers } from "../../../scene/motion/answers";
import { jointsOf } from "../../../scene/motion/joints";
import { motionRows } from "../../../scene/motion/motion-rows";
import { hingesOf, NODE, nodeAt, pose, STAND } from "../../../scene/motion/pose";
import { SharedClock } from "../../../scene/motion/shared-clock";
import { Sway } from "../../../scene/motion/sway";
import { LIVE_PERIOD, type Wind, windOf } from "../../../scene/motion/wind";
import { Winds } from "../../../scene/motion/winds";
import { ServerTime } from "../../connection/server-time";

const FRAME = 16;
const tree = SWAYING_TREES[1]!;
const { joints, wood } = jointsOf(motionRows(tableOfSwaying(tree)), tree, tree.suppleness);
const wind = windOf({ velocity: [8, 0, 2], turbulence: 0.7, seed: 7 }, LIVE_PERIOD);
const answers = (to: Wind) => new Answers(joints, to, new Float64Array(joints.count).fill(1));
const sway = new Sway(answers(wind));
const hinges = hingesOf(joints, wood);

/** Where the tips of limbs are at a time in seconds, in metres. */
function tipsAt(time: number, of: Sway = sway): Float64Array {
  const bends = new Float64Array(3 * joints.count);
  const stands = new Float64Array(STAND * joints.count);
  of.bends(time, bends);
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

/** Where the tips of the first page are on average. */
function meanOf(looks: readonly Float64Array[][]): Float64Array {
  return looks[0]![0]!.map((_, i) => looks.reduce((sum, [first]) => sum + first![i]!, 0) / looks.length);
}

function rmsApart(looks: readonly Float64Array[][], apart: (look: Float64Array[], i: number) => number): number {
  const count = looks[0]![0]!.length;
  let sum = 0;
  for (const look of looks) for (let i = 0; i < count; i += 1) sum += apart(look, i) ** 2;
  return Math.sqrt(sum / (looks.length * count));
}

/** Milliseconds after which each device hears of a wind that was set. */
const LAGS = [8, 90, 240];
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
      if (settled && time % (25 * FRAME) === 0) looks.push(times.map((each) => tipsAt(each)));
    }
    expect(looks.length).toBeGreaterThan(60);
    const mean = meanOf(looks);
    const amplitude = rmsApart(looks, ([first], i) => first![i]! - mean[i]!);
    expect(amplitude, "the wind moves them").toBeGreaterThan(0.001);
    for (const other of [1, 2]) {
      const apart = rmsApart(looks, (look, i) => look[other]![i]! - look[0]![i]!);
      expect(apart / amplitude, `device ${other}`).toBeLessThan(0.02);
    }
  });

  it("see one wind take over from another at the same time, whoever set it and whoever heard late", () => {
    const of = (speed: number): AirSettings => ({ ...CALM, speed, direction: 20, turbulence: 0.7 });
    // A preset, and then a finger that drags: when the server had them.
    const sets = [70_110, 74_020, 74_090, 74_190, 74_310, 74_420].map((at, i) => ({
      at,
      settings: of([16, 15, 12, 9, 7, 4][i]!),
    }));
    const blow = (settings: AirSettings) =>
      answers(windOf({ velocity: velocityOf(settings), turbulence: settings.turbulence, seed: 7 }, LIVE_PERIOD));
    const pages = DEVICES.map((device, i) => {
      const winds = new Winds();
      winds.begin(of(8));
      const heard = [...sets];
      // The first page sets them: it shows them before the server has them, by half of its way.
      const own = i === 0 ? [...sets] : [];
      const sway = new Sway(blow(of(8)));
      const at = pageOf(device, i + 1);
      return (now: number) => {
        const time = at(now);
        while (own.length > 0 && own[0]!.at - device.way / 2 <= now) winds.set(own.shift()!.settings, null);
        while (heard.length > 0 && heard[0]!.at + LAGS[i]! <= now) {
          const { at, settings } = heard.shift()!;
          if (own.length === 0 || own[0]!.at > at + device.way) winds.set(settings, at / 1000);
        }
        winds.pass(sway, time, blow, () => expect.fail("nothing comes as a surprise"));
        return () => tipsAt(time, sway);
      };
    });
    const looks: Float64Array[][] = [];
    for (let now = 30_000; now <= 78_000; now += FRAME) {
      const tips = pages.map((page) => page(now));
      // From when the last has heard of it until long after.
      const settled = (now > 70_110 + 260 && now < 72_500) || now > 74_420 + 260;
      if (settled && now % (3 * FRAME) === 0) looks.push(tips.map((each) => each()));
    }
    const mean = meanOf(looks);
    const swing = rmsApart(looks, ([first], i) => first![i]! - mean[i]!);
    for (const other of [1, 2]) {
      const apart = rmsApart(looks, (look, i) => look[other]![i]! - look[0]![i]!);
      expect(apart / swing, `device ${other}`).toBeLessThan(0.02);
    }
  });
});
