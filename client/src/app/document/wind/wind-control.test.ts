import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Air } from "../../../scene/motion/air";
import { type AirSettings, CALM } from "../../../scene/motion/air-settings";
import type { Hand } from "../../../scene/motion/hand";
import { DEFAULT_PARAMETERS, type LeafKind } from "../../../wire/generated";
import { placeOnDisc, windAt } from "./compass";
import { WindControl, type WindTold } from "./wind-control";
import { PRESET_NAMES, presetOf, WIND_PRESETS } from "./wind-presets";

function page({ calmly = false } = {}) {
  const told = {
    made: 0,
    settings: null as AirSettings | null,
    leaves: 0,
    since: null as number | null,
    touched: null as Hand | null,
    held: false,
    warm: false,
  };
  const [touched, leaves] = [signal<Hand | null>(null), signal<LeafKind>("ovate")];
  const settings = signal<AirSettings>(CALM);
  const heard = signal<WindTold | null>(null);
  const air = {
    set: (settings: AirSettings, _: unknown, leaves: number, since: number | null) =>
      Object.assign(told, { settings, leaves, since }),
    touch: (touched: Hand | null) => Object.assign(told, { touched }),
    hold: (held: boolean) => Object.assign(told, { held }),
    warm: () => Object.assign(told, { warm: true }),
  } as unknown as Air;
  const put = (patch: Partial<AirSettings>) => {
    settings.value = { ...settings.peek(), ...patch };
  };
  const wind = new WindControl({
    settings,
    told: heard,
    drag: put,
    commit: put,
    parameters: signal(DEFAULT_PARAMETERS),
    leaves: () => leaves.value,
    touched: () => touched.value,
    enliven: () => {
      told.made += 1;
      return air;
    },
    air: () => air,
    calmly,
  });
  return { wind, told, touched, leaves, put, heard };
}

describe("the wind on a page", () => {
  it("is made when it first blows", () => {
    const { wind, told } = page();
    expect(told.made).toBe(0);
    wind.set({ turbulence: 1 });
    expect(told.made).toBe(0);
    wind.set({ speed: 5 });
    wind.set({ speed: 6 });
    expect(told.made).toBe(1);
    expect(told.settings).toEqual({ ...CALM, turbulence: 1, speed: 6 });
  });

  it("is made ready where somebody is about to set one, and blows no sooner for that", () => {
    const { wind, told } = page();
    wind.getReady();
    wind.getReady();
    expect([told.made, told.warm, told.settings]).toEqual([1, true, null]);
    wind.set({ speed: 5 });
    expect([told.made, told.settings!.speed]).toEqual([1, 5]);
  });

  it("is the one that others set", () => {
    const { wind, told, put } = page();
    put({ speed: 12, direction: 90 });
    expect(told.made).toBe(1);
    expect(told.settings).toEqual({ ...CALM, speed: 12, direction: 90 });
    expect(wind.settings.value.speed).toBe(12);
  });

  it("has blown since when the server says, once that has told of it", () => {
    const { wind, told, put, heard } = page();
    wind.set({ speed: 5 });
    expect(told.since).toBeNull();
    heard.value = { settings: { ...CALM, speed: 5 }, since: 12_340 };
    expect(told.since).toBe(12.34);
    put({ speed: 6 });
    expect(told.since, "a change of one's own that it has yet to answer").toBeNull();
  });

  it("is held and let go, and rests under a hand", () => {
    const { wind, told, touched } = page();
    wind.set({ speed: 5 });
    wind.toggle();
    expect(told.held).toBe(true);
    wind.toggle();
    expect(told.held).toBe(false);
    touched.value = { rows: [7], elsewhere: 0.25 };
    expect(told.touched).toEqual({ rows: [7], elsewhere: 0.25 });
    touched.value = null;
    expect(told.touched).toBeNull();
  });

  it("does not move where less motion is asked for, until it is asked for itself", () => {
    const { wind, told } = page({ calmly: true });
    wind.set({ speed: 5 });
    expect(told.settings).toEqual(CALM);
    wind.toggle();
    expect(told.settings!.speed).toBe(5);
    expect(told.held).toBe(false);
  });

  it("shows what lies on trees where less motion is asked for, and can be let go in a calm", () => {
    const { wind, told } = page({ calmly: true });
    wind.set({ speed: 5, rise: 1, snow: 0.2, sag: 0.5, rain: 1 });
    expect(told.settings).toEqual({ ...CALM, snow: 0.2, sag: 0.5, rain: 1 });
    wind.set({ speed: 0, rise: 0 });
    expect(wind.toggles).toBe(true);
    wind.toggle();
    expect([wind.mode.value, wind.toggles]).toEqual(["moving", false]);
    wind.set({ speed: 5 });
    expect(wind.toggles).toBe(true);
  });

  it("flutters by the form of leaves", () => {
    const { wind, told, leaves } = page();
    wind.set({ speed: 5 });
    expect(told.leaves).toBe(1);
    leaves.value = "needle";
    expect(told.leaves).toBeLessThan(0.5);
    leaves.value = "round";
    expect(told.leaves).toBeGreaterThan(1);
  });

  it("ends with what it follows", () => {
    const { wind, told, touched } = page();
    wind.set({ speed: 5 });
    wind.dispose();
    touched.value = { rows: [], elsewhere: 0.25 };
    expect(told.touched).toBeNull();
  });
});

describe("winds to pick from", () => {
  it("are found again, and leave where the wind blows to", () => {
    for (const name of PRESET_NAMES) {
      const settings = { ...CALM, direction: 70, ...WIND_PRESETS[name] };
      expect(presetOf(settings)).toBe(name);
      expect(settings.direction).toBe(70);
    }
    expect(presetOf({ ...CALM, speed: 5 })).toBe(null);
  });
});

describe("the disc", () => {
  it("means the wind whose knob stands there, however the tree is turned", () => {
    for (const turned of [0, 90, -135]) {
      for (const [speed, direction] of [
        [10, 40],
        [25, 355],
        [4, 180],
      ] as const) {
        const [x, y] = placeOnDisc(speed, direction, turned);
        expect(windAt(x, y, turned)).toEqual({ speed, direction });
      }
    }
  });

  it("is calm in its middle and strongest beyond its rim", () => {
    expect(windAt(0.01, 0, 0)).toEqual({ speed: 0 });
    expect(windAt(5, 0, 0)).toEqual({ speed: 25, direction: 0 });
    expect(windAt(0, -5, 0)).toEqual({ speed: 25, direction: 270 });
  });
});
