import type { Background, Sky } from "../../wire/generated";
import type { Vec3 } from "../vector";

/** The light of a sky; colours are linear. */
export interface SkyLight {
  /** Towards the sun, or towards the moon once it has set. */
  readonly towards: Vec3;
  readonly sun: Vec3;
  /** From above, and back from the ground. */
  readonly above: Vec3;
  readonly below: Vec3;
  readonly zenith: Vec3;
  readonly middle: Vec3;
  readonly horizon: Vec3;
  /** What far land pales to. */
  readonly air: Vec3;
  /** Around the sun. */
  readonly glow: Vec3;
  /** Share of the sky under clouds, and how bright they are. */
  readonly clouds: number;
  readonly cloud: Vec3;
  /** How much of the stars is seen, 0 to 1. */
  readonly stars: number;
  /** How far hills show, 0 to 1. */
  readonly hills: number;
  /** How wide the penumbra is: tangent of the sun's half angle. */
  readonly spread: number;
  /** Exposure: 1 by day, more in the dark. */
  readonly opened: number;
  /** Saturation: 1 keeps colours as they are; it is higher by day than by night. */
  readonly vivid: number;
}

/** The part of the light that depends on the time of day. */
interface Hour {
  readonly elevation: number;
  readonly sun: Vec3;
  readonly above: Vec3;
  readonly zenith: Vec3;
  readonly middle: Vec3;
  readonly horizon: Vec3;
  readonly glow: Vec3;
}

/** A sky without clouds, by the sun's elevation in degrees. */
const HOURS: readonly Hour[] = [
  {
    elevation: -10,
    sun: [0.3, 0.47, 0.92],
    above: [0.095, 0.15, 0.36],
    zenith: [0.007, 0.016, 0.055],
    middle: [0.016, 0.036, 0.105],
    horizon: [0.045, 0.08, 0.165],
    glow: [0.05, 0.07, 0.12],
  },
  {
    elevation: -4.5,
    sun: [0, 0, 0],
    above: [0.63, 0.57, 0.7],
    zenith: [0.03, 0.055, 0.16],
    middle: [0.12, 0.13, 0.27],
    horizon: [0.5, 0.29, 0.26],
    glow: [0.4, 0.14, 0.08],
  },
  {
    elevation: 0,
    sun: [1.8, 0.86, 0.42],
    above: [0.5, 0.48, 0.58],
    zenith: [0.09, 0.15, 0.34],
    middle: [0.36, 0.33, 0.43],
    horizon: [0.98, 0.56, 0.36],
    glow: [0.8, 0.36, 0.14],
  },
  {
    elevation: 7,
    sun: [3, 2.02, 1.14],
    above: [0.44, 0.48, 0.58],
    zenith: [0.13, 0.25, 0.5],
    middle: [0.45, 0.51, 0.62],
    horizon: [1.04, 0.78, 0.53],
    glow: [0.6, 0.38, 0.19],
  },
  {
    elevation: 20,
    sun: [3.2, 2.56, 1.82],
    above: [0.42, 0.54, 0.74],
    zenith: [0.14, 0.31, 0.61],
    middle: [0.34, 0.56, 0.84],
    horizon: [1.02, 0.93, 0.79],
    glow: [0.32, 0.26, 0.18],
  },
  {
    elevation: 45,
    sun: [3.3, 2.92, 2.36],
    above: [0.42, 0.57, 0.8],
    zenith: [0.13, 0.31, 0.62],
    middle: [0.32, 0.56, 0.88],
    horizon: [1, 0.98, 0.91],
    glow: [0.22, 0.19, 0.14],
  },
  {
    elevation: 90,
    sun: [3.3, 3.06, 2.66],
    above: [0.43, 0.58, 0.8],
    zenith: [0.12, 0.3, 0.62],
    middle: [0.3, 0.55, 0.89],
    horizon: [0.99, 0.99, 0.95],
    glow: [0.2, 0.18, 0.14],
  },
];

/** Where the day's last light has gone and the moon takes over, in degrees. */
const MOONRISE = -4.5;
const MOON_ELEVATION = 38;
/** The moon stands this far round from where the sun went down, in degrees. */
const MOON_ASIDE = 130;
/** A light lower than this casts shadows longer than any map. */
const LOWEST_LIGHT = 4;
/** How much brighter the sky is to look at than what it gives to see by, as eyes and films have it: most at its rim. */
const SKY_GAIN = { zenith: 1.25, middle: 1.3, horizon: 1.55, cloud: 1.7 } as const;
/** Tone mapping flattens colours; a little more saturation restores them. By moonlight eyes see hardly any. */
const DAY_VIVID = 1.42;
const NIGHT_VIVID = 0.8;
/** How green or bright the ground sends light back. */
const BOUNCE: Record<Background["ground"], Vec3> = {
  grass: [0.3, 0.31, 0.17],
  earth: [0.34, 0.26, 0.19],
  sand: [0.56, 0.47, 0.34],
  snow: [0.86, 0.9, 0.97],
  plain: [0.5, 0.5, 0.5],
};
const HAZE: Record<Sky, { clouds: number; hills: number; spread: number }> = {
  meadow: { clouds: 0.36, hills: 1, spread: 0.009 },
  clear: { clouds: 0, hills: 0, spread: 0.007 },
  overcast: { clouds: 1, hills: 0.75, spread: 0.35 },
  studio: { clouds: 0, hills: 0, spread: 0.06 },
};

/** The light of a background. */
export function skyLight({ sky, ground, backdrop, sun_azimuth, sun_elevation }: Background): SkyLight {
  const hour = hourAt(sun_elevation);
  const dark = sun_elevation < MOONRISE;
  const towards = dark
    ? direction(sun_azimuth + MOON_ASIDE, MOON_ELEVATION)
    : direction(sun_azimuth, Math.max(sun_elevation, LOWEST_LIGHT));
  const opened = 1 + 0.55 * clamp((9 - sun_elevation) / 13);
  const vivid = DAY_VIVID + (NIGHT_VIVID - DAY_VIVID) * clamp((-3 - sun_elevation) / 6);
  const common = { towards, opened, vivid, ...HAZE[sky] };
  const stars = clamp((-3 - sun_elevation) / 6);
  switch (sky) {
    case "meadow":
    case "clear": {
      const below = bounced(hour, towards, BOUNCE[ground]);
      const cloud = scale(mix(mix(hour.horizon, gray(hour.horizon), 0.4), hour.sun, 0.16), 1.3 * SKY_GAIN.cloud);
      const zenith = scale(hour.zenith, SKY_GAIN.zenith);
      const middle = scale(hour.middle, SKY_GAIN.middle);
      const horizon = scale(hour.horizon, SKY_GAIN.horizon);
      return {
        ...common,
        ...hour,
        zenith,
        middle,
        horizon,
        air: airOf(middle, horizon),
        below,
        cloud,
        stars: sky === "clear" ? stars : 0.5 * stars,
      };
    }
    case "overcast": {
      // Clouds hide where the sun is and let through what it and the sky give together.
      const day = scale(add(scale(hour.above, 1.05), scale(hour.sun, 0.16 * Math.max(0.3, towards[1]))), 0.92);
      const grey = mix(day, gray(day), 0.72);
      const faint = scale(mix(hour.sun, gray(hour.sun), 0.7), 0.11);
      return {
        ...common,
        sun: faint,
        opened: opened * 1.06,
        above: scale(grey, 1.95),
        below: scale(times(grey, BOUNCE[ground]), 1.25),
        zenith: scale(grey, 0.85),
        middle: scale(grey, 1.15),
        horizon: scale(grey, 1.5),
        air: airOf(scale(grey, 1.15), scale(grey, 1.5)),
        glow: scale(faint, 0.12),
        cloud: scale(grey, 1.6),
        stars: 0,
      };
    }
    case "studio": {
      // A lamp where the sun is, and a big soft one above; only the hour's warmth is left of the sky.
      const paper = backdrop.map((value) => linear(value / 255)) as unknown as Vec3;
      const lamp = 0.6 + 0.4 * clamp((sun_elevation + 10) / 40);
      const warm = clamp(1 - sun_elevation / 25);
      const sun = scale(mix([1, 0.965, 0.91], [1, 0.74, 0.48], warm), 2.5 * lamp);
      return {
        ...common,
        opened: 1,
        vivid: DAY_VIVID,
        towards: direction(sun_azimuth, Math.max(sun_elevation, 12)),
        sun,
        above: mix([0.62, 0.63, 0.66], scale(paper, 0.9), 0.25),
        below: scale(paper, 0.36),
        zenith: scale(paper, 0.9),
        middle: paper,
        horizon: scale(paper, 1.06),
        air: scale(paper, 1.06),
        glow: [0, 0, 0],
        cloud: paper,
        stars: 0,
      };
    }
  }
}

/** Towards a place in the sky, from angles in degrees: from z towards x, and above the horizon. */
export function direction(azimuth: number, elevation: number): Vec3 {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  return [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
}

function hourAt(elevation: number): Omit<Hour, "elevation"> {
  const after = Math.max(
    1,
    HOURS.findIndex((hour, i) => i === HOURS.length - 1 || hour.elevation >= elevation),
  );
  const [a, b] = [HOURS[after - 1]!, HOURS[after]!];
  const t = clamp((elevation - a.elevation) / (b.elevation - a.elevation));
  const between = (name: Exclude<keyof Hour, "elevation">) => mix(a[name], b[name], t);
  return {
    sun: between("sun"),
    above: between("above"),
    zenith: between("zenith"),
    middle: between("middle"),
    horizon: between("horizon"),
    glow: between("glow"),
  };
}

/** The air before far land is a little darker than the sky above it. */
function airOf(middle: Vec3, horizon: Vec3): Vec3 {
  return scale(mix(middle, horizon, 0.35), 0.72);
}

/** The light that the ground reflects. */
function bounced(hour: Omit<Hour, "elevation">, towards: Vec3, albedo: Vec3): Vec3 {
  return times(add(scale(hour.sun, 0.22 * towards[1]), scale(hour.above, 0.55)), albedo);
}

function linear(value: number): number {
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

function clamp(value: number): number {
  return Math.min(1, Math.max(0, value));
}

function mix(a: Vec3, b: Vec3, t: number): Vec3 {
  return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
}

function add(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

function times(a: Vec3, b: Vec3): Vec3 {
  return [a[0] * b[0], a[1] * b[1], a[2] * b[2]];
}

function scale(a: Vec3, factor: number): Vec3 {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

function gray(colour: Vec3): Vec3 {
  const value = 0.21 * colour[0] + 0.72 * colour[1] + 0.07 * colour[2];
  return [value, value, value];
}
