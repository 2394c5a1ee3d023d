import { describe, expect, it } from "vitest";
import { SMALL, tableOf } from "../../../test/small-tree";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { BendOverlay } from "../overlay/bend-overlay";
import { Overlays } from "../overlay/overlays";
import { AIR_NUMBERS, soundAir } from "./air-numbers";
import { type AirName, type AirSettings, CALM, velocityOf } from "./air-settings";
import { Answers } from "./answers";
import { Hands } from "./hands";
import { JointWork } from "./joint-work";
import { loaded } from "./loads";
import { motionRows } from "./motion-rows";
import { restingPlace, swayedPlace } from "./places";
import { pose, STAND } from "./pose";
import { Riding } from "./riding";
import { Sway } from "./sway";
import { LIVE_PERIOD, windOf } from "./wind";

const names = Object.keys(CALM) as AirName[];
const all = (value: number) => Object.fromEntries(names.map((name) => [name, value])) as AirSettings;

/** A table's rows as they stand in settings at a time. */
function swaying(table: ReturnType<typeof tableOf>, asked: AirSettings, time: number, scale = SCALE) {
  const settings = soundAir(asked);
  const rows = motionRows(table);
  const { moving, exposure } = new JointWork().make({
    grown: { rows, scale, suppleness: 1 },
    along: [1, 0, 0],
    obstacles: { standing: [], meshes: [] },
  });
  const { turbulence, damping } = settings;
  const wind = windOf({ velocity: velocityOf(settings), turbulence, seed: 7 }, LIVE_PERIOD);
  const sag = loaded(moving!.loads, settings);
  const sway = new Sway(new Answers(moving!.joints, wind, exposure, { damping, sag }));
  const bends = new Float64Array(3 * moving!.joints.count);
  const stands = new Float64Array(STAND * moving!.joints.count);
  const riding = new Riding(moving!, rows.parent, rows.quantised);
  const hands = new Hands();
  hands.adopt(moving!, null, { table, riding }, table.radiusCode);
  hands.touch({ rows: [table.rows - 1, 10_000_000, -3], elsewhere: 0.25 });
  hands.release([table.rows - 1, 10_000_000, -3]);
  sway.forget(time);
  sway.bends(time, bends);
  hands.apply(1000 * time, time, { table, riding, moving: moving!, sway }, bends, exposure);
  pose(moving!.hinges, bends, stands);
  return { stands, riding, bends };
}
const SCALE = { internodeLength: 0.1, leafSize: 1 };

describe("a wind that cannot be", () => {
  it.each([Number.NaN, 1e9, -1e9, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY])(
    "of %s is one that can",
    (value) => {
      const sound = soundAir(all(value));
      for (const name of names) {
        expect(sound[name]).toBeGreaterThanOrEqual(AIR_NUMBERS[name].least);
        expect(sound[name]).toBeLessThanOrEqual(AIR_NUMBERS[name].most);
      }
      const { bends, stands } = swaying(tableOfSwaying(SWAYING_TREES[1]!), all(value), 12.5);
      expect([...bends, ...stands].every(Number.isFinite)).toBe(true);
    },
  );

  it("leaves alone what can be", () => {
    const settings = { ...CALM, speed: 8, direction: 70, rise: -2, snow: 0.1 };
    expect(soundAir(settings)).toEqual(settings);
  });
});

describe("a clock that jumps", () => {
  it.each([0, -1e12, 1e12, 86_400 * 365 * 50])(
    "to %s s leaves a tree as far from where it grew as any wind does",
    (time) => {
      const { bends } = swaying(tableOfSwaying(SWAYING_TREES[1]!), { ...CALM, speed: 25, turbulence: 1 }, time);
      for (let at = 0; at < bends.length; at += 3) {
        expect(Math.hypot(bends[at]!, bends[at + 1]!, bends[at + 2]!)).toBeLessThan(1.2);
      }
    },
  );
});

describe("a tree that is hardly one", () => {
  it.each([
    ["nothing", []],
    ["a seed", SMALL.slice(0, 1)],
    ["one metamer", SMALL.slice(0, 2)],
  ])("%s is seen, and met, at finite places", (_, twigs) => {
    const table = tableOf(twigs);
    const { stands, riding } = swaying(table, { ...CALM, speed: 25, turbulence: 1, snow: 0.5 }, 3);
    const seen = swayedPlace(stands, riding, null);
    for (let row = 0; row < table.rows; row += 1) expect(seen(table, row).every(Number.isFinite)).toBe(true);
  });
});

describe("a bend in progress while wind blows", () => {
  const table = tableOf(SMALL);
  const overlays = new Overlays();
  const bend = new BendOverlay(table, [6, 7, 8, 9]);
  overlays.add(bend);
  bend.move([{ row: 9, rotation: [0, 0, 0, 1], to: [4, 5, 1] }]);
  overlays.assign(table, () => {}, true);
  const supple = tableOf(SMALL.map((twig) => ({ ...twig, radius: 0.01 })));
  const { stands, riding } = swaying(supple, { ...CALM, speed: 20, turbulence: 0 }, 3);
  stands.set(stands.map((each, i) => (i % STAND === 7 ? each + 0.5 : each)));

  it("is seen where the hand has it, carried as far as the wind carries the branch", () => {
    const [seen, free] = [swayedPlace(stands, riding, overlays), swayedPlace(stands, riding, null)];
    const carried = [0, 1, 2].map((a) => free(table, 9)[a]! - table.course.placed[27 + a]!);
    expect(Math.hypot(...carried), "the wind carries it").toBeGreaterThan(0.1);
    for (const a of [0, 1, 2]) expect(seen(table, 9)[a]).toBeCloseTo([4, 5, 1][a]! + carried[a]!, 6);
  });

  it("is met there, at a place of the branch as it is bent", () => {
    const seen = swayedPlace(stands, riding, overlays);
    const rest = restingPlace(table, { row: 9, point: seen(table, 9) }, seen, overlays);
    for (const a of [0, 1, 2]) expect(rest[a]).toBeCloseTo([4, 5, 1][a]!, 6);
  });
});
