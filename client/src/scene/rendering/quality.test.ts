import { describe, expect, it } from "vitest";
import { QUALITIES, QualityControl, REST_AFTER } from "./quality";

/** A device whose frames cost a fixed part and a part for every pixel, shown at most 60 times a second. */
interface Device {
  fixed: number;
  pixels: number;
}

const duration = ({ fixed, pixels }: Device, scale: number) => Math.max(16.7, fixed + pixels * scale ** 2);

/** Moves for a while; gives the scale of every frame. */
function move(control: QualityControl, device: Device, milliseconds: number, from = 0): number[] {
  const scales: number[] = [];
  control.moved(from);
  for (let now = from; now < from + milliseconds; ) {
    const { scale } = control.quality;
    scales.push(scale);
    const cost = duration(device, scale);
    now += cost;
    control.moved(now);
    control.measured(cost);
  }
  return scales;
}

const changes = (scales: number[]) => scales.filter((scale, i) => i > 0 && scale !== scales[i - 1]).length;
const tablet = { fixed: 3, pixels: 9 };
const software = { fixed: 40, pixels: 500 };

describe("quality control", () => {
  it("a fast device keeps the whole quality", () => {
    expect(new Set(move(new QualityControl(), tablet, 10_000))).toEqual(new Set([1]));
  });

  it("a display of 30 frames a second is not slow", () => {
    expect(new Set(move(new QualityControl(), { fixed: 33.4, pixels: 0 }, 10_000))).toEqual(new Set([1]));
  });

  it("a very slow device is quick from its third frame on", () => {
    const scales = move(new QualityControl(), software, 4000);
    expect(scales.slice(0, 2)).toEqual([1, 1]);
    expect(new Set(scales.slice(2))).toEqual(new Set([0.35]));
  });

  it("a device that is a little slow loses a little", () => {
    const scales = move(new QualityControl(), { fixed: 5, pixels: 60 }, 4000);
    expect(scales.at(-1)).toBe(0.7);
    expect(changes(scales)).toBe(1);
  });

  it("never swings to and fro while a movement goes on", () => {
    for (let fixed = 0; fixed <= 60; fixed += 4) {
      for (let pixels = 0; pixels <= 400; pixels += 10) {
        const scales = move(new QualityControl(), { fixed, pixels }, 15_000);
        expect(changes(scales), `${fixed} + ${pixels} ms`).toBeLessThanOrEqual(QUALITIES.length - 1);
        expect(scales, `${fixed} + ${pixels} ms`).toEqual([...scales].sort((a, b) => b - a));
      }
    }
  });

  it("one frame that stumbles changes nothing", () => {
    const control = new QualityControl();
    control.moved(0);
    for (const cost of [17, 17, 400, 17, 17, 17, 900, 17]) {
      control.measured(cost);
      expect(control.quality.scale).toBe(1);
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
    expect(new Set(move(control, software, 4000, 5000))).toEqual(new Set([0.35]));
  });

  it("what was slow for a while becomes whole again", () => {
    const control = new QualityControl();
    move(control, software, 4000);
    for (let turn = 1; turn <= QUALITIES.length; turn += 1) {
      control.rest();
      move(control, tablet, 500, 10_000 * turn);
    }
    expect(control.quality.scale).toBe(1);
  });

  it("a long movement that has become quick gains quality", () => {
    const control = new QualityControl();
    move(control, software, 4000);
    control.rest();
    const scales = move(control, tablet, 6000, 10_000);
    expect(scales[0]).toBe(0.35);
    expect(scales.at(-1)).toBe(1);
    expect(changes(scales)).toBe(QUALITIES.length - 1);
  });

  it("shadows wait the longer the less time there is", () => {
    const waits = QUALITIES.map(({ shadowEvery }) => shadowEvery);
    expect(waits[0]).toBe(0);
    expect(waits.at(-1)).toBe(Number.POSITIVE_INFINITY);
    expect(waits).toEqual([...waits].sort((a, b) => a - b));
  });

  it("a page opens modestly, and no movement pays for that", () => {
    const control = new QualityControl();
    control.open(0);
    expect(control.quality.scale).toBeLessThan(1);
    for (const cost of [900, 700, 400, 300]) control.measured(cost);
    expect(control.quality.scale).toBe(0.5);
    control.rest();
    expect(control.quality).toBe(QUALITIES[0]);
    expect(new Set(move(control, tablet, 1000, 5000))).toEqual(new Set([1]));
  });
});
