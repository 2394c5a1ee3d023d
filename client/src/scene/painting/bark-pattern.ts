import type { BarkKind } from "../../wire/generated";
import { cells, noCell, step, turbulence, waves } from "./bark-noise";

/** One place of a bark. */
export interface BarkPoint {
  /** 0 in the deepest crack to 1 on the highest ridge. */
  height: number;
  /** How bright the bark's own colour is there. */
  shade: number;
  /** Shares of the second and the third colour of its kind. */
  second: number;
  third: number;
}

/** Writes what a bark has at a place of its unit square: u around the limb, v along it. */
export type BarkPattern = (u: number, v: number, out: BarkPoint) => void;

/** The pattern of each kind. Made when it is asked for, since each fills tables first. */
export const BARK_PATTERNS: Record<BarkKind, () => BarkPattern> = {
  smooth,
  furrowed,
  plated,
  papery,
  flaking,
  banded,
  stringy,
};

/** Beech: a grey skin, finely wrinkled around, with clouds of lichen and drifts of algae. */
function smooth(): BarkPattern {
  const clouds = turbulence(3, 3, 4, 11);
  const swirls = turbulence(4, 5, 3, 18);
  const lichen = turbulence(6, 8, 4, 12);
  const specks = cells(17, 23, 1, 19);
  const wrinkles = waves(5, 46, 13);
  const folds = waves(4, 12, 14);
  const drifts = turbulence(9, 2, 3, 15);
  const pores = cells(11, 30, 0.9, 16);
  const grain = waves(90, 90, 17);
  const cell = noCell();
  return (u, v, out) => {
    const cloud = clouds(u, v);
    const swirl = swirls(u, v);
    const warp = 0.02 * cloud;
    const fine = grain(u, v);
    const wrinkle = wrinkles(u, v + warp) * step(-0.1, 0.5, folds(u + 0.3, v));
    const { across, along, chance } = pores(u, v, cell);
    const pore = chance > 0.62 ? 1 - step(0.3, 1, Math.hypot(across / 0.26, along / 0.16)) : 0;
    // Lichen has no outline: it thins out into grains, and small round ones stand apart.
    const grown = lichen(u + 0.07 * swirl, v + 0.07 * cloud) + 0.22 * fine;
    const { nearest, chance: own } = specks(u + 0.012 * swirl, v, cell);
    const speck = own > 0.72 ? 1 - step(0.12, 0.34, nearest + 0.08 * fine) : 0;
    const patch = Math.max(0.8 * step(0, 0.8, grown), 0.75 * speck);
    out.height =
      0.55 + 0.1 * wrinkle + 0.1 * folds(u, v + warp) + 0.07 * pore + 0.05 * patch + 0.025 * fine + 0.06 * swirl;
    out.second = 0.5 * step(0, 0.8, drifts(u + warp, v) + 0.3 * swirl) * (1 - patch);
    out.third = 0.42 * patch;
    out.shade = 0.93 + 0.16 * cloud + 0.1 * swirl + 0.12 * wrinkle - 0.3 * pore + 0.07 * fine;
  };
}

/** Oak, elm, willow: rounded ridges that part and meet again around long furrows. */
function furrowed(): BarkPattern {
  const bends = turbulence(3, 2, 3, 21);
  const furrows = turbulence(9, 1, 2, 22);
  const others = turbulence(12, 2, 2, 29);
  const splits = waves(13, 3, 23);
  const tones = waves(7, 3, 28);
  const breaks = cells(15, 9, 1, 24);
  const fibres = turbulence(30, 5, 3, 25);
  const grain = waves(110, 60, 26);
  const lichen = turbulence(4, 4, 4, 27);
  const cell = noCell();
  return (u, v, out) => {
    const bend = bends(u, v);
    const fibre = fibres(u + 0.03 * bend, v);
    const x = u + 0.045 * bend + 0.008 * fibre;
    const y = v + 0.1 * bends(v, u);
    // Furrows are where fields of long waves pass through nothing: they wander, meet and part again.
    const main = Math.abs(furrows(x, y));
    const side = Math.abs(others(x, y)) + 0.03;
    const gap = Math.min(main, side, 0.8 * Math.abs(splits(x, y)) + 0.1);
    const ridge = step(0, 0.2, gap);
    const tone = tones(x, y);
    const crack = breaks(x, y + 0.3 * tone, cell);
    const broken = step(0.02, 0.16, crack.second - crack.nearest);
    const worn = 0.6 + 0.4 * Math.sqrt(step(0, 0.6, gap));
    out.height =
      ridge * worn * (0.84 + 0.16 * broken) * (0.94 + 0.12 * tone) +
      0.1 * fibre * (0.4 + 0.6 * ridge) +
      0.03 * grain(u, v);
    const depth = 1 - step(0.04, 0.55, out.height);
    const patch = step(0.2, 0.5, lichen(u, v)) * step(0.45, 0.8, out.height);
    out.second = 0.8 * depth;
    out.third = 0.5 * patch;
    out.shade = 0.7 + 0.36 * out.height + 0.12 * tone + 0.2 * fibre + 0.06 * grain(u, v);
  };
}

/** Pine: long plates of thin scales, layer upon layer, fox-red where they came off, dark and deep between them. */
function plated(): BarkPattern {
  const bends = turbulence(3, 2, 4, 31);
  const plates = cells(9, 3, 1, 37);
  const scales = cells(19, 11, 1, 34);
  const layers = turbulence(7, 5, 5, 33);
  const flutes = waves(9, 3, 36);
  const grain = turbulence(60, 44, 3, 35);
  const clouds = turbulence(4, 3, 3, 38);
  const cell = noCell();
  return (u, v, out) => {
    const bend = bends(u, v);
    const fine = layers(u, v);
    const rough = grain(u, v);
    const x = u + 0.07 * bend + 0.02 * fine + 0.003 * rough;
    const y = v + 0.14 * bends(v, u) + 0.035 * layers(v, u);
    const { nearest, second, chance } = plates(x, y, cell);
    // Furrows are wide and run on along the stem; from side to side plates only part.
    const gap = second - nearest;
    const furrow = step(0, 0.2, gap + 0.1 * fine) * (0.6 + 0.4 * step(0.03, 0.26, Math.abs(flutes(x, y)) + 0.4 * gap));
    const scale = scales(x + 0.012 * rough, y + 0.02 * fine, cell);
    // Scales lie on each other, the topmost in the middle of a plate: each ends in a thin lip over the next.
    const level = 3.4 * step(0, 0.7, gap) + 1.5 * scale.chance + 2.4 * fine + 0.8 * chance;
    const rest = level - Math.floor(level);
    const layer = Math.min(1, Math.max(0, 0.16 * (Math.floor(level) + step(0.7, 1, rest))));
    const edge = step(0, 0.22, scale.second - scale.nearest);
    out.height = furrow * (0.34 + 0.5 * layer + 0.1 * edge) + 0.06 * rough;
    const deep = 1 - step(0.1, 0.66, furrow);
    const bare = 1 - step(0.25, 0.7, layer + 0.2 * fine + 0.12 * clouds(u, v));
    out.third = 0.85 * deep;
    out.second = (0.28 * bare + 0.1 * chance) * (1 - out.third);
    out.shade =
      (0.72 + 0.26 * layer + 0.24 * (chance - 0.5) + 0.2 * (scale.chance - 0.5) + 0.24 * rough + 0.12 * clouds(u, v)) *
      (0.8 + 0.2 * edge) *
      (0.78 + 0.22 * step(0, 0.3, rest));
  };
}

/** Birch: white skin with dark pores across it, that peels in curls and breaks into black diamonds. */
function papery(): BarkPattern {
  const clouds = turbulence(3, 4, 4, 41);
  const streaks = turbulence(5, 44, 2, 42);
  const pores = cells(5, 34, 0.95, 43);
  const fine = cells(12, 60, 0.95, 44);
  const scars = cells(2, 3, 0.7, 45);
  const ragged = turbulence(14, 22, 3, 46);
  const sheets = turbulence(2, 7, 3, 47);
  const cell = noCell();
  const dash = (across: number, along: number, long: number, wide: number) =>
    1 - step(0.55, 1, Math.hypot(across / long, along / wide));
  return (u, v, out) => {
    const cloud = clouds(u, v);
    const rough = ragged(u, v);
    const y = v + 0.006 * cloud;
    const coarse = pores(u, y, cell);
    const pore =
      coarse.chance > 0.35
        ? dash(coarse.across + 0.1 * rough, coarse.along, 0.16 + 0.36 * (coarse.chance - 0.35), 0.2)
        : 0;
    const small = fine(u, y, cell);
    const speck = small.chance > 0.5 ? 0.7 * dash(small.across, small.along, 0.42, 0.2) : 0;
    const { across, along, chance } = scars(u, v, cell);
    // A diamond, wider than high, torn at its rim, under what once was a branch.
    const size = Math.max(0, chance - 0.45);
    const torn =
      Math.abs(across) / (0.62 * size + 0.02) + Math.abs(along + 0.1 * across * across) / (0.3 * size + 0.01);
    const scar = 1 - step(0.7, 1.05, torn + 0.45 * rough);
    const sheet = sheets(u, v + 0.004 * rough);
    const peeled = step(0.2, 0.215, sheet);
    const lip = peeled * (1 - step(0.2, 0.33, sheet));
    const mark = Math.max(pore, speck * (1 - 0.5 * peeled));
    out.height =
      0.62 - 0.16 * peeled + 0.04 * streaks(u, v) + 0.07 * mark + scar * (0.16 * rough - 0.28) + 0.03 * cloud;
    out.second = Math.max(0.9 * scar * (0.75 + 0.25 * rough), 0.78 * mark);
    out.third = (1 - out.second) * Math.min(1, 0.85 * lip + 0.12 * peeled + 0.1 * step(0.2, 0.7, cloud));
    out.shade = 0.93 + 0.08 * cloud + 0.08 * streaks(u, v) + 0.03 * rough;
  };
}

/** Plane: patches that came off one after the other, each with the colour of its age. */
function flaking(): BarkPattern {
  const bends = turbulence(6, 6, 3, 51);
  const oldest = turbulence(4, 4, 4, 52);
  const older = turbulence(5, 4, 4, 53);
  const young = turbulence(5, 5, 4, 54);
  const grain = turbulence(40, 40, 2, 55);
  const pores = waves(34, 60, 56);
  return (u, v, out) => {
    const bend = bends(u, v);
    const x = u + 0.012 * bend;
    const y = v + 0.012 * bends(v, u);
    const grey = step(0.06, 0.1, oldest(x, y) + 0.03 * bend);
    const olive = step(-0.06, -0.02, older(x, y) + 0.03 * bend);
    const cream = step(0.12, 0.16, young(x, y));
    // The oldest bark lies on top of all others.
    const top = Math.max(grey, 0);
    const middle = olive * (1 - top);
    const fresh = cream * (1 - top) * (1 - olive);
    const rest = Math.max(0, 1 - top - middle - fresh);
    out.height = 0.3 + 0.4 * top + 0.24 * middle - 0.1 * fresh + 0.05 * grain(u, v) * (0.3 + top) + 0.02 * pores(u, v);
    out.second = Math.min(1, 0.9 * fresh + 0.45 * rest);
    out.third = 0.85 * top;
    out.shade = 0.95 + 0.16 * bend + 0.1 * grain(u, v) - 0.1 * middle;
  };
}

/** Cherry: a skin with a sheen, and rows of wide corky pores around the stem. */
function banded(): BarkPattern {
  const clouds = turbulence(3, 4, 4, 61);
  const sheen = turbulence(3, 56, 2, 62);
  const bands = waves(2, 7, 63);
  const pores = cells(4, 20, 0.85, 64);
  const fine = cells(9, 44, 0.95, 65);
  const rough = turbulence(30, 30, 3, 66);
  const peels = turbulence(2, 6, 3, 67);
  const cell = noCell();
  return (u, v, out) => {
    const cloud = clouds(u, v);
    const y = v + 0.012 * cloud;
    const band = step(-0.05, 0.4, bands(u, y));
    const noise = rough(u, v);
    const wide = pores(u, y, cell);
    const long = (0.2 + 0.5 * wide.chance) * (0.55 + 0.45 * band);
    const cork =
      1 - step(0.55, 1.05, Math.hypot(wide.across / long, (wide.along + 0.06 * noise) / (0.14 + 0.12 * wide.chance)));
    const slit = cork * (1 - step(0.02, 0.06, Math.abs(wide.along + 0.08 * noise)));
    const small = fine(u, y, cell);
    const speck = small.chance > 0.45 ? 1 - step(0.4, 1, Math.hypot(small.across / 0.36, small.along / 0.18)) : 0;
    const peel = step(0.26, 0.28, peels(u, v + 0.01 * cloud));
    const lens = Math.max(cork, 0.6 * speck);
    out.height = 0.45 + 0.3 * lens * (1 + 0.4 * noise) - 0.22 * slit + 0.05 * sheen(u, v) + 0.1 * peel + 0.03 * cloud;
    out.second = 0.8 * lens * (1 - slit);
    out.third = (1 - out.second) * Math.max(0.5 * peel * (1 - step(0.28, 0.4, peels(u, v))), 0.6 * slit);
    out.shade = 0.9 + 0.2 * cloud + 0.16 * sheen(u, v) - 0.1 * band;
  };
}

/** Juniper, cypress: long fibres in strips that come loose. */
function stringy(): BarkPattern {
  const bends = turbulence(4, 2, 3, 71);
  const ropes = waves(9, 2, 72);
  const strips = turbulence(16, 2, 2, 73);
  const fibres = turbulence(44, 4, 3, 74);
  const loose = turbulence(8, 3, 3, 75);
  const grey = turbulence(7, 3, 3, 76);
  return (u, v, out) => {
    const bend = bends(u, v);
    const x = u + 0.05 * bend;
    const rope = 1 - step(0, 0.75, Math.abs(ropes(x, v)));
    const strip = strips(x + 0.01 * fibres(u, v), v);
    const split = step(0.02, 0.16, Math.abs(strip));
    const fibre = fibres(x, v + 0.02 * bend);
    const lifted = step(0.16, 0.2, loose(x, v));
    out.height = 0.2 + 0.28 * (1 - rope) * split + 0.24 * split + 0.2 * lifted + 0.16 * fibre;
    out.second = Math.min(1, 0.8 * (1 - split) * (1 - lifted) + 0.25 * (1 - lifted) * (1 - step(0.1, 0.5, out.height)));
    out.third = 0.6 * lifted * step(-0.1, 0.4, grey(u, v)) * (1 - out.second);
    out.shade = 0.72 + 0.4 * out.height + 0.26 * fibre;
  };
}
