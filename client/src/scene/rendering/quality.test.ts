import { describe, expect, it } from "vitest";
import { openingOf, QUALITIES, type Quality, QualityControl, REST_AFTER } from "./quality";

/** A device whose frames take a fixed time and one that goes with what they cost, shown at most 60 times a second. */
interface Device {
  fixed: number;
  whole: number;
}

const duration = ({ fixed, whole }: Device, { cost }: Quality) => Math.max(16.7, fixed + whole * cost);
const LAST = QUALITIES.length - 1;
/** What is given up for speed, in this order, each for itself. */
const GIVEN_UP = ["leaves", "shadows", "scale"] as const;

/** Moves for a while; gives the level of every frame. */
function move(control: QualityControl, device: Device, milliseconds: number, from = 0): number[] {
  const levels: number[] = [];
  control.moved(from);
  for (let now = from; now < from + milliseconds; ) {
    levels.push(QUALITIES.indexOf(control.quality));
    const cost = duration(device, control.quality);
    now += cost;
    control.moved(now);
    control.measured(cost);
  }
  return levels;
}

const changes = (levels: number[]) => levels.filter((level, i) => i > 0 && level !== levels[i - 1]).length;
const tablet = { fixed: 3, whole: 9 };
const software = { fixed: 40, whole: 900 };

describe("quality control", () => {
  it("a fast device keeps the whole quality", () => {
    expect(new Set(move(new QualityControl(), tablet, 10_000))).toEqual(new Set([0]));
  });

  it("a display of 30 frames a second is not slow", () => {
    expect(new Set(move(new QualityControl(), { fixed: 33.4, whole: 0 }, 10_000))).toEqual(new Set([0]));
  });

  it("a very slow device is quick from its third frame on", () => {
    const levels = move(new QualityControl(), software, 4000);
    expect(levels.slice(0, 2)).toEqual([0, 0]);
    expect(new Set(levels.slice(2))).toEqual(new Set([LAST]));
  });

  it("a device that is a little slow loses a little, and no pixels", () => {
    const control = new QualityControl();
    const levels = move(control, { fixed: 5, whole: 60 }, 4000);
    expect(levels.at(-1)).toBe(1);
    expect(changes(levels)).toBe(1);
    expect(control.quality.scale).toBe(1);
    expect(control.quality.smooth).toBe(true);
  });

  it("what is seen least is given up first", () => {
    const shown = QUALITIES.map((one) => [one.scale, one.smooth ? 1 : 0, one.shadows, one.leaves, one.cost]);
    for (const [i, column] of shown[0]!.entries()) {
      const values = shown.map((row) => row[i]!);
      expect(values, `${column} falls`).toEqual([...values].sort((a, b) => b - a));
    }
    const first = (lost: (quality: Quality) => boolean) => QUALITIES.findIndex(lost);
    expect(first(({ shadowEvery }) => shadowEvery > 0)).toBeLessThan(first(({ scale }) => scale < 1));
    expect(
      QUALITIES.every(({ shadows }) => Math.log2(shadows) % 1 === 0),
      "texels are powers of two",
    ).toBe(true);
    expect(first(({ scale }) => scale < 1)).toBeLessThan(first(({ smooth }) => !smooth));
    expect(QUALITIES[LAST]!.scale, "no pixel is a block").toBeGreaterThanOrEqual(0.4);
  });

  it("fewer frames a second cost leaves first, then texels of shadows, then pixels", () => {
    const lost: (typeof GIVEN_UP)[number][] = [];
    for (let whole = 30; whole <= 900; whole *= 1.05) {
      const control = new QualityControl();
      move(control, { fixed: 2, whole }, 4000);
      const { leaves, shadows, scale } = control.quality;
      const now = { leaves, shadows, scale };
      const more = GIVEN_UP.filter((name) => now[name] < QUALITIES[0][name] && !lost.includes(name));
      expect(more.length, `at ${whole} ms`).toBeLessThanOrEqual(1);
      lost.push(...more);
    }
    expect(lost).toEqual(GIVEN_UP);
  });

  it("never swings to and fro while a movement goes on", () => {
    for (let fixed = 0; fixed <= 60; fixed += 4) {
      for (let whole = 0; whole <= 400; whole += 10) {
        const levels = move(new QualityControl(), { fixed, whole }, 15_000);
        expect(changes(levels), `${fixed} + ${whole} ms`).toBeLessThanOrEqual(LAST);
        expect(levels, `${fixed} + ${whole} ms`).toEqual([...levels].sort((a, b) => a - b));
      }
    }
  });

  it("one frame that stumbles changes nothing", () => {
    const control = new QualityControl();
    control.moved(0);
    for (const cost of [17, 17, 400, 17, 17, 17, 900, 17]) {
      control.measured(cost);
      expect(control.quality).toBe(QUALITIES[0]);
    }
  });

  it("the picture at rest is whole and comes once, 250 ms after", () => {
    const control = new QualityControl();
    expect(control.restIn(0)).toBeNull();
    move(control, software, 4000);
    control.moved(10_000);
    expect(control.restIn(10_000)).toBe(REST_AFTER);
    expect(control.restIn(10_100)).toBe(REST_AFTER - 100);
    expect(control.restIn(12_000)).toBe(0);
    control.rest();
    expect(control.quality).toBe(QUALITIES[0]);
    expect(control.restIn(12_001)).toBeNull();
  });

  it("the next movement of a slow device is quick at once", () => {
    const control = new QualityControl();
    move(control, software, 4000);
    control.rest();
    expect(new Set(move(control, software, 4000, 5000))).toEqual(new Set([LAST]));
  });

  it("what was slow for a while becomes whole again", () => {
    const control = new QualityControl();
    move(control, software, 4000);
    for (let turn = 1; turn <= QUALITIES.length; turn += 1) {
      control.rest();
      move(control, tablet, 500, 10_000 * turn);
    }
    expect(control.quality).toBe(QUALITIES[0]);
  });

  it("a long movement that has become quick gains quality", () => {
    const control = new QualityControl();
    move(control, software, 4000);
    control.rest();
    const levels = move(control, tablet, 6000, 10_000);
    expect(levels[0]).toBe(LAST);
    expect(levels.at(-1)).toBe(0);
    expect(changes(levels)).toBe(LAST);
  });

  it("a device that is slow at its quickest is told of, and no other", () => {
    for (const [device, overtaxed] of [
      [software, true],
      [{ fixed: 5, whole: 200 }, false],
      [tablet, false],
    ] as const) {
      const control = new QualityControl();
      move(control, device, 4000);
      expect(control.overtaxed).toBe(overtaxed);
    }
  });

  it("a device that is known to be slow begins with its quickest frames, and gains from there", () => {
    const control = new QualityControl(true);
    expect(new Set(move(control, software, 4000))).toEqual(new Set([LAST]));
    control.rest();
    expect(move(control, tablet, 6000, 10_000).at(-1)).toBe(0);
  });

  it("shadows wait the longer the less time there is", () => {
    const waits = QUALITIES.map(({ shadowEvery }) => shadowEvery);
    expect(waits[0]).toBe(0);
    expect(waits).toEqual([...waits].sort((a, b) => a - b));
  });

  it("a page opens modestly, and no movement pays for that", () => {
    const control = new QualityControl();
    const opening = openingOf(false);
    control.open(0);
    expect(control.quality).toBe(opening);
    expect(opening.scale).toBeLessThan(1);
    for (const cost of [900, 700, 400, 300]) control.measured(cost);
    expect(control.quality).toBe(opening);
    control.rest();
    expect(control.quality).toBe(QUALITIES[0]);
    expect(new Set(move(control, tablet, 1000, 5000))).toEqual(new Set([0]));
  });
});

describe("the picture at rest of a device that is known to be slow", () => {
  /** Opens a page there and lets it rest; gives the levels drawn at rest, one after the other. */
  function rested(device: Device, control = new QualityControl(true)): number[] {
    control.open(0);
    expect(control.quality, "something is seen as soon as can be").toBe(QUALITIES[LAST]);
    // The first frames also make everything ready.
    control.measured(9 * duration(device, control.quality));
    return rise(control, device);
  }

  function rise(control: QualityControl, device: Device): number[] {
    control.rest();
    const levels: number[] = [];
    do {
      levels.push(QUALITIES.indexOf(control.quality));
      control.measured(duration(device, control.quality));
    } while (control.rise());
    return levels;
  }

  it("gets finer as far as it is drawn in time, and never coarser", () => {
    const slow = { fixed: 100, whole: 12_000 };
    const control = new QualityControl(true);
    const levels = rested(slow, control);
    expect(levels[0]).toBe(LAST);
    expect(levels).toEqual([...new Set(levels)].sort((a, b) => b - a));
    expect(levels.length).toBeGreaterThan(1);
    for (const level of levels) expect(duration(slow, QUALITIES[level]!), `level ${level}`).toBeLessThan(5000);
    expect(control.quality.scale, "as fine as time allows").toBeGreaterThan(QUALITIES[LAST]!.scale);
    expect(control.rising).toBe(true);
  });

  it("stays as the page opened where even that takes long", () => {
    expect(rested({ fixed: 0, whole: 200_000 })).toEqual([LAST]);
  });

  it("is the whole one where that does not take long, and then nothing more comes", () => {
    const control = new QualityControl(true);
    expect(rested({ fixed: 10, whole: 600 }, control)).toEqual([LAST, 0]);
    expect(control.rising).toBe(false);
    move(control, { fixed: 10, whole: 600 }, 2000, 5000);
    expect(rise(control, { fixed: 10, whole: 600 }), "what is known is not tried again").toEqual([0]);
  });

  it("is the whole one at once where that is wished for", () => {
    const control = new QualityControl(true);
    control.thorough = true;
    expect(rested({ fixed: 100, whole: 12_000 }, control)).toEqual([0]);
  });

  it("nobody waits for a better one once it moves", () => {
    const control = new QualityControl(true);
    control.open(0);
    control.rest();
    control.moved(10);
    expect([control.rising, control.rise()]).toEqual([false, false]);
    expect(control.quality).toBe(QUALITIES[LAST]);
  });
});
