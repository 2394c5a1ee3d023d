import { describe, expect, it } from "vitest";
import { blows, CALM, stilled, stirs } from "./air-settings";
import { Amount } from "./amount";
import { Pace } from "./pace";
import { SharedClock } from "./shared-clock";

describe("what is set of the wind", () => {
  it("moves nothing before anybody has set it", () => {
    expect(blows(CALM)).toBe(false);
    expect(blows({ ...CALM, speed: 0.5 })).toBe(true);
    for (const load of ["sag", "snow", "rain"] as const) {
      expect(blows({ ...CALM, [load]: 0.5 })).toBe(true);
      expect(stirs({ ...CALM, [load]: 0.5 })).toBe(false);
    }
    expect(stirs({ ...CALM, rise: -2 })).toBe(true);
    const storm = { ...CALM, speed: 18, rise: 3, snow: 0.2, sag: 1, flutter: 2 };
    expect(stilled(storm)).toEqual({ ...storm, speed: 0, rise: 0 });
    expect(stirs(stilled(storm))).toBe(false);
  });
});

describe("how much wind there is", () => {
  it("rises, is none a quarter of a second after a hand has come, and dies away", () => {
    const amount = new Amount();
    expect(amount.at(0, true, false)).toBe(0);
    expect(amount.at(600, true, false)).toBeCloseTo(0.5);
    expect(amount.at(1200, true, false)).toBe(1);
    expect(amount.changing).toBe(false);
    expect(amount.at(1200, true, true)).toBe(1);
    expect(amount.at(1325, true, true)).toBeCloseTo(0.5);
    expect(amount.at(1450, true, true)).toBe(0);
    expect(amount.at(1450, true, false)).toBe(0);
    expect(amount.changing).toBe(true);
    expect(amount.at(9000, true, false)).toBe(1);
    expect(amount.at(9000, false, false)).toBe(1);
    expect(amount.at(9600, false, false)).toBeCloseTo(0.5);
    expect(amount.at(20_000, false, false)).toBe(0);
  });

  it("rises from where it is, however long ago the last frame was, but for what it has missed", () => {
    const amount = new Amount();
    amount.at(0, false, false);
    expect(amount.at(60_000, true, false)).toBe(0);
    expect(amount.at(60_600, true, false)).toBeCloseTo(0.5);
    expect(new Amount().at(60_000, true, false, 300)).toBeCloseTo(0.15625);
  });

  it("rises once there is something to show it with", () => {
    const amount = new Amount();
    for (let now = 0; now < 3000; now += 16) amount.wait(true);
    expect(amount.at(3000, true, false, 300)).toBe(0);
    expect(amount.changing).toBe(true);
    expect(amount.at(3600, true, false)).toBeCloseTo(0.5);
  });

  it("stays within 0 and 1 where the clock goes back", () => {
    const amount = new Amount();
    amount.at(5000, true, false);
    expect(amount.at(10, true, false)).toBe(0);
    expect(amount.at(20, true, false)).toBeGreaterThan(0);
  });
});

describe("frames of the wind", () => {
  const draw = (pace: Pace, every: number, count: number, from = 0) => {
    let heavy = false;
    for (let i = 0; i < count; i += 1) heavy = pace.heavy(from + i * every);
    return heavy;
  };

  it("come sixty times a second at most, and thirty where they are slow", () => {
    const pace = new Pace();
    expect(pace.early(0)).toBe(false);
    draw(pace, 16.7, 20);
    const last = 19 * 16.7;
    expect(pace.early(last + 8.3)).toBe(true);
    expect(pace.early(last + 16.6)).toBe(false);
    draw(pace, 30, 20, last);
    expect(pace.early(last + 19 * 30 + 16.6)).toBe(true);
    expect(pace.early(last + 19 * 30 + 33)).toBe(false);
  });

  it("make the picture coarser only where they are slow all the same, until the wind rests", () => {
    expect(draw(new Pace(), 33, 60)).toBe(false);
    const pace = new Pace();
    expect(draw(pace, 60, 12)).toBe(true);
    pace.rest();
    expect(draw(pace, 16.7, 12, 5000)).toBe(false);
    expect(draw(new Pace(), 900, 3)).toBe(true);
  });

  it("have a shadow that follows some times in a second", () => {
    const pace = new Pace();
    const drawn = Array.from({ length: 60 }, (_, i) => pace.shadow(i * 16.7)).filter(Boolean).length;
    expect(drawn).toBeGreaterThan(10);
    expect(drawn).toBeLessThan(20);
  });
});

describe("the time that all share", () => {
  function clocks() {
    const time = { own: 100, shared: 5000 };
    return {
      time,
      clock: new SharedClock(
        () => time.own,
        () => time.shared,
      ),
    };
  }

  it("goes on as the device's own, and follows the others' slowly", () => {
    const { time, clock } = clocks();
    expect(clock.read()).toEqual({ time: 5000, jumped: false });
    time.own += 1;
    time.shared += 1.5;
    const { time: now, jumped } = clock.read();
    expect(jumped).toBe(false);
    expect(now).toBeCloseTo(5001.005);
  });

  it("jumps where it is set to another time, and says so", () => {
    const { time, clock } = clocks();
    time.shared += 3600;
    expect(clock.read()).toEqual({ time: 8600, jumped: true });
    expect(clock.read().jumped).toBe(false);
  });

  it("goes on where there is no telling the time", () => {
    const { time, clock } = clocks();
    time.shared = Number.NaN;
    time.own += 2;
    expect(clock.read()).toEqual({ time: 5002, jumped: false });
  });
});
