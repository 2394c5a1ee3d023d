import { describe, expect, it } from "vitest";
import type { Vec3 } from "../vector";
import { type AirSettings, CALM, velocityOf } from "./air-settings";
import type { Answers } from "./answers";
import { type Blend, blendOf, blendOver } from "./blend";
import { FADE, type Sway } from "./sway";
import { MOST_GUSTS } from "./sway-shaders";
import { LIVE_PERIOD, windOf } from "./wind";
import { BEAT, Winds } from "./winds";

const BREEZE: AirSettings = { ...CALM, speed: 4, direction: 20, turbulence: 0.4, flutter: 0.5 };
const STORM: AirSettings = { ...CALM, speed: 18, direction: 200, rise: 2, turbulence: 0.9, flutter: 2 };
const SNOW: AirSettings = { ...CALM, snow: 0.15 };
const RAIN: AirSettings = { ...STORM, direction: 90, rain: 1 };

const windIn = (settings: AirSettings) =>
  windOf({ velocity: velocityOf(settings), turbulence: settings.turbulence, seed: 7 }, LIVE_PERIOD);
const SWAY = { change: () => {}, retime: () => {} } as unknown as Sway;
const pass = (winds: Winds, time: number) =>
  winds.pass(
    SWAY,
    time,
    () => ({}) as Answers,
    () => {},
  );
const blendAt = (winds: Winds, time: number) => blendOf(winds.shares(time), windIn, time);

const PLACES: readonly Vec3[] = [
  [0, 0, 0],
  [3, 8, -2],
  [-5, 2, 6],
];

/** What is seen of it: numbers of uniforms, and the speed in some places. */
function seenOf({ speed, lee, gusts, flutter, snow, rain }: Blend): number[] {
  const speeds = PLACES.map((place) =>
    gusts.reduce(
      (sum, { wave, angle, size }) => sum + size * Math.cos(angle - wave.reduce((all, k, a) => all + k * place[a]!, 0)),
      speed,
    ),
  );
  return [speed, ...lee.map((each) => each * speed), flutter, snow, rain, ...speeds];
}

const furthest = (one: number[], other: number[]) => Math.max(...one.map((each, i) => Math.abs(each - other[i]!)));

describe("leaves and weather while one wind takes over from another", () => {
  it.each([
    ["a breeze and a storm from elsewhere", BREEZE, STORM],
    ["a storm and a breeze", STORM, BREEZE],
    ["a storm and snow without wind", STORM, SNOW],
    ["snow without wind and a storm", SNOW, STORM],
    ["snow and rain", SNOW, RAIN],
  ])("go from one to the other without a jump: %s", (_, from, to) => {
    const winds = new Winds();
    winds.begin(from);
    winds.set(to, 10);
    const STEP = 1e-4;
    // Before and after each moment, among them those at which the one sets in and the other is gone.
    for (let moment = 9.9; moment < 10.1 + FADE; moment = Math.round(100 * (moment + 0.05)) / 100) {
      const [before, after] = [moment - STEP, moment].map((time) => {
        pass(winds, time);
        return seenOf(blendAt(winds, time));
      });
      // Gusts of a storm turn by some tens of m/s in a second.
      expect(furthest(before!, after!), `about ${moment}`).toBeLessThan(0.02);
    }
    expect(seenOf(blendAt(winds, 10 + FADE))).toEqual(seenOf(blendOf([{ settings: to, share: 1 }], windIn, 10 + FADE)));
  });

  it("are in the middle between them half way", () => {
    const winds = new Winds();
    winds.begin(BREEZE);
    winds.set({ ...SNOW, flutter: 1.5 }, 10);
    pass(winds, 10 + FADE / 2);
    const { speed, flutter, snow, lee } = blendAt(winds, 10 + FADE / 2);
    expect([speed, flutter, snow]).toEqual([2, 1, 0.5].map((each) => expect.closeTo(each)));
    // Snow without wind turns no leaves.
    const turn = (20 * Math.PI) / 180;
    expect(lee).toEqual([Math.cos(turn), 0, Math.sin(turn)].map((each) => expect.closeTo(each)));
  });

  it("have no more gusts than shaders take, however a finger drags, and lose none", () => {
    const winds = new Winds();
    winds.begin(STORM);
    let most = 0;
    for (let beat = 0; beat < 40; beat += 1) {
      const time = 10 + beat * BEAT;
      winds.set({ ...STORM, speed: 5 + (beat % 20), direction: 9 * beat }, time);
      pass(winds, time);
      for (const now of [time, time + BEAT / 2]) {
        most = Math.max(most, blendAt(winds, now).gusts.length);
        expect(winds.shares(now).reduce((sum, { share }) => sum + share, 0)).toBeCloseTo(1);
      }
    }
    expect(most).toBeGreaterThan(MOST_GUSTS / 2);
    expect(most).toBeLessThanOrEqual(MOST_GUSTS);
  });
});

it("a wind that comes as a surprise takes over leaves and weather by and by", () => {
  const [before, now] = [BREEZE, RAIN].map((settings) => blendOf([{ settings, share: 1 }], windIn, 3)) as [
    Blend,
    Blend,
  ];
  expect(blendOver(before, now, 0)).toEqual({ ...before, speed: now.speed, gusts: now.gusts });
  expect(blendOver(before, now, 0.5).rain).toBe(0.5);
  expect(blendOver(before, now, 1)).toBe(now);
  expect(blendOver(null, now, 0)).toBe(now);
});
