import type { Vec3 } from "../vector";
import { type AirSettings, alongOf } from "./air-settings";
import { angleAt, type Wind } from "./wind";
import type { WindShare } from "./winds";

/** Metres of snow that hide what they lie on. */
const COVERED = 0.04;

/** A spectral line of the speed along a wind, as it is at a time. */
export interface Gust {
  /** Wave number, radians per metre. */
  readonly wave: Vec3;
  readonly angle: number;
  /** Amplitude, m/s. */
  readonly size: number;
}

/** What leaves, snow and rain have of all winds that blow at a time, while one takes over from another. */
export interface Blend {
  /** Mean speed 10 m above the ground, m/s. */
  readonly speed: number;
  /** Where it blows: times the speed this is the mean of the velocities. */
  readonly lee: Vec3;
  /** Those of the newest wind first. */
  readonly gusts: readonly Gust[];
  readonly flutter: number;
  /** How far snow covers what it lies on, and how wet everything is, 0 to 1 each. */
  readonly snow: number;
  readonly rain: number;
}

/** The mean of winds, each by its share. */
export function blendOf(shares: readonly WindShare[], windIn: (settings: AirSettings) => Wind, time: number): Blend {
  const winds = shares.map(({ settings, share }) => ({ settings, share, wind: windIn(settings) })).reverse();
  const sum = (of: (each: (typeof winds)[number]) => number) =>
    winds.reduce((whole, each) => whole + each.share * of(each), 0);
  const speed = sum(({ wind }) => wind.speed);
  // Where no wind blows it has no direction: that of one that rises or dies away does not turn meanwhile.
  const along = (axis: 0 | 1 | 2) =>
    sum(({ settings, wind }) => (speed > 0 ? wind.speed / speed : 1) * alongOf(settings)[axis]);
  return {
    speed,
    lee: [along(0), along(1), along(2)],
    gusts: winds.flatMap(({ wind, share }) =>
      wind.lines
        .filter(({ direction }) => direction === 0)
        .map(({ harmonic, amplitude, phase, wave }) => ({
          wave,
          angle: angleAt(harmonic, wind.period, time) + phase,
          size: share * wind.speed * amplitude,
        })),
    ),
    flutter: sum(({ settings }) => settings.flutter),
    snow: sum(({ settings }) => Math.min(1, settings.snow / COVERED)),
    rain: sum(({ settings }) => settings.rain),
  };
}

/** What is shown while one picture of the wind comes over another; speed and gusts do so row by row. */
export function blendOver(before: Blend | null, now: Blend, share: number): Blend {
  if (!before || share === 1) return now;
  const between = (one: number, other: number) => one + share * (other - one);
  return {
    ...now,
    lee: [between(before.lee[0], now.lee[0]), between(before.lee[1], now.lee[1]), between(before.lee[2], now.lee[2])],
    flutter: between(before.flutter, now.flutter),
    snow: between(before.snow, now.snow),
    rain: between(before.rain, now.rain),
  };
}
