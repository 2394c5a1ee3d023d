import { describe, expect, it } from "vitest";
import { type AirSettings, CALM } from "./air-settings";
import type { Answers } from "./answers";
import type { Sway } from "./sway";
import { LATE, Winds } from "./winds";

const wind = (speed: number): AirSettings => ({ ...CALM, speed });

/** Winds in a tree that only notes which sets in when. */
function setUp() {
  const winds = new Winds();
  const told: string[] = [];
  let late = 0;
  const sway = {
    change: (answers: { speed: number }, at: number) => told.push(`${answers.speed} at ${at}`),
    retime: (at: number) => told.push(`at ${at} after all`),
  } as unknown as Sway;
  const pass = (time: number) => {
    winds.pass(
      sway,
      time,
      ({ speed }) => ({ speed }) as unknown as Answers,
      () => {
        late += 1;
      },
    );
    return told.splice(0);
  };
  winds.begin(wind(1));
  return { winds, pass, late: () => late };
}

describe("winds", () => {
  it("set in at the next quarter of a second after they were set, the last of several", () => {
    const { winds, pass } = setUp();
    winds.set(wind(3), 10.01);
    winds.set(wind(4), 10.2);
    expect(pass(10.22)).toEqual([]);
    expect(winds.waiting).toBe(true);
    winds.set(wind(5), 10.24);
    expect(pass(10.26)).toEqual(["5 at 10.25"]);
    expect(winds.waiting).toBe(false);
    winds.set(wind(6), 10.5);
    expect(pass(10.5)).toEqual(["6 at 10.5"]);
  });

  it("are the same however late they are heard of", () => {
    const sets: [number, number][] = [
      [3, 10.01],
      [4, 10.2],
      [5, 10.3],
      [6, 10.9],
    ];
    const heard = (delay: number) => {
      const { winds, pass } = setUp();
      const set = [...sets];
      const all: string[] = [];
      for (let time = 10; time < 12; time += 1 / 60) {
        while (set.length > 0 && set[0]![1] + delay <= time) winds.set(wind(set[0]![0]), set.shift()![1]);
        all.push(...pass(time));
      }
      return all;
    };
    expect(heard(0.01)).toEqual(["4 at 10.25", "5 at 10.5", "6 at 11"]);
    expect(heard(0.04)).toEqual(heard(0.01));
    // What sets in is first another one here, and then the same.
    expect(heard(0.2).slice(-3)).toEqual(["4 at 10.25", "5 at 10.5", "6 at 11"]);
  });

  it("of one's own set in at once, and where the server has it once that has told", () => {
    const { winds, pass } = setUp();
    winds.set(wind(3), null);
    pass(10.24);
    expect(pass(10.25)).toEqual(["3 at 10.25"]);
    winds.set(wind(3), null);
    winds.set(wind(3), 10.26);
    expect(pass(10.3)).toEqual(["at 10.5 after all"]);
    winds.set(wind(3), 10.26);
    expect(pass(10.4)).toEqual([]);
  });

  it("are left alone by a server that begins anew, and by a time that is still to come", () => {
    const { winds, pass } = setUp();
    winds.set(wind(3), 100);
    expect(pass(100)).toEqual(["3 at 100"]);
    winds.set(wind(3), 0);
    expect(pass(0.5)).toEqual([]);
    winds.set(wind(4), 1e9);
    expect(pass(0.5)).toEqual(["4 at 0.5"]);
    winds.set(wind(5), Number.NaN);
    expect(pass(0.75)).toEqual(["5 at 0.75"]);
  });

  it("that are heard of long after come as a surprise, and no more than the last two are made up for", () => {
    const { winds, pass, late } = setUp();
    for (let i = 0; i < 20; i += 1) winds.set(wind(2 + i), 10 + i);
    expect(pass(40)).toEqual(["20 at 28", "21 at 29"]);
    expect(late()).toBe(2);
    winds.set(wind(3), 40);
    expect(winds.lateness(40.1)).toBeCloseTo(0.1);
    expect(winds.lateness(40 + LATE + 0.01)).toBe(0);
    expect(winds.lateness(39)).toBe(0);
  });

  it("do not set in where there is none", () => {
    const { winds, pass } = setUp();
    winds.set(CALM, 10);
    expect(pass(11)).toEqual([]);
    expect(winds.waiting).toBe(false);
  });

  it("have other shelter from when they turned, and later from when it is known", () => {
    const { winds, pass } = setUp();
    winds.set(wind(3), 10);
    expect(pass(10)).toEqual(["3 at 10"]);
    winds.shelter();
    expect(pass(10.2)).toEqual(["3 at 10"]);
    winds.shelter();
    expect(pass(60)).toEqual(["3 at 60"]);
  });

  it("go on as they are where other joints stand in them", () => {
    const { winds, pass } = setUp();
    winds.set(wind(3), 10);
    pass(10);
    pass(10.4);
    winds.set(wind(5), 10.9);
    expect(pass(10.95)).toEqual([]);
    const shares = winds.shares(10.95);
    const seen: number[] = [];
    const count = { count: 1, rate: [1], damping: [0.1] };
    const sway = winds.stand(wind(9), ({ speed }) => {
      const bends = (_: number, out: Float64Array) => out.fill(speed / 10);
      seen.push(speed);
      return { ...count, bends } as unknown as Answers;
    });
    expect(seen, "that which fades, and that which blows").toEqual([1, 3]);
    expect(winds.shares(10.95)).toEqual(shares);
    const bends = new Float64Array(3);
    sway.bends(10.75, bends);
    expect(bends[0], "half way").toBeCloseTo(0.2);
    expect(pass(11), "that which was to come").toEqual(["5 at 11"]);
  });

  it("share what is seen by the time alone", () => {
    const { winds, pass } = setUp();
    winds.set(wind(3), 10);
    winds.set(wind(5), 10.75);
    pass(10.75);
    const speeds = (time: number) => winds.shares(time).map(({ settings, share }) => [settings.speed, share]);
    expect(speeds(10.75)).toEqual([
      [1, 0.5],
      [3, 0.5],
    ]);
    expect(speeds(11.5)).toEqual([
      [3, 0.5],
      [5, 0.5],
    ]);
    expect(speeds(20)).toEqual([[5, 1]]);
    // The server may have begun anew.
    expect(speeds(0)).toEqual([[1, 1]]);
  });

  it("of other flutter set in like any other", () => {
    const { winds, pass } = setUp();
    winds.set({ ...wind(1), flutter: 2 }, 10);
    expect(pass(10)).toEqual(["1 at 10"]);
  });

  it("are there at once where time stands still", () => {
    const { winds } = setUp();
    winds.set(wind(3), 10);
    winds.set(wind(4), null);
    expect(winds.latest(5)).toEqual(wind(4));
    expect(winds.latest(5)).toBeNull();
  });
});
