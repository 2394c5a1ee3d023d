import { leafHash } from "../leaf-hash";

/** A field over the unit square that goes on without a seam beyond its borders. */
export type Field = (u: number, v: number) => number;

/** What is near a place in a pattern of cells. */
export interface Cell {
  /** Distances to the nearest and the second nearest middle, in cells. */
  nearest: number;
  second: number;
  /** From the nearest middle, in cells. */
  across: number;
  along: number;
  /** Random, 0 to 1, one for each cell. */
  chance: number;
}

/** Perlin's gradient noise, about −1 to 1, with so many lattice cells across and along. */
export function waves(across: number, along: number, seed: number): Field {
  const gradients = new Float32Array(2 * across * along);
  for (let at = 0; at < across * along; at += 1) {
    const angle = 2 * Math.PI * chanceOf(at, seed);
    gradients[2 * at] = Math.SQRT2 * Math.cos(angle);
    gradients[2 * at + 1] = Math.SQRT2 * Math.sin(angle);
  }
  return (u, v) => {
    const x = u * across;
    const y = v * along;
    const i = Math.floor(x);
    const j = Math.floor(y);
    const dx = x - i;
    const dy = y - j;
    const left = 2 * wrapped(i, across);
    const right = left + 2 === 2 * across ? 0 : left + 2;
    const low = 2 * wrapped(j, along) * across;
    const high = low + 2 * across === gradients.length ? 0 : low + 2 * across;
    const sx = dx * dx * dx * (dx * (6 * dx - 15) + 10);
    const sy = dy * dy * dy * (dy * (6 * dy - 15) + 10);
    const a = gradients[low + left]! * dx + gradients[low + left + 1]! * dy;
    const b = gradients[low + right]! * (dx - 1) + gradients[low + right + 1]! * dy;
    const c = gradients[high + left]! * dx + gradients[high + left + 1]! * (dy - 1);
    const d = gradients[high + right]! * (dx - 1) + gradients[high + right + 1]! * (dy - 1);
    const below = a + (b - a) * sx;
    const above = c + (d - c) * sx;
    return below + (above - below) * sy;
  };
}

/** Waves with finer ones on top, each twice as fine and half as high. */
export function turbulence(across: number, along: number, octaves: number, seed: number): Field {
  const layers = Array.from({ length: octaves }, (_, i) => waves(across << i, along << i, seed + 101 * i));
  return (u, v) => {
    let sum = 0;
    let height = 1;
    for (let i = 0; i < octaves; i += 1) {
      sum += height * layers[i]!(u, v);
      height *= 0.5;
    }
    return sum;
  };
}

/** Worley's cells, so many across and along, their middles strewn by `spread` of a cell; writes into `out`. */
export function cells(across: number, along: number, spread: number, seed: number) {
  const count = across * along;
  const middles = new Float32Array(2 * count);
  const chances = new Float32Array(count);
  for (let at = 0; at < count; at += 1) {
    middles[2 * at] = 0.5 + spread * (chanceOf(at, seed) - 0.5);
    middles[2 * at + 1] = 0.5 + spread * (chanceOf(at, seed + 1) - 0.5);
    chances[at] = chanceOf(at, seed + 2);
  }
  return (u: number, v: number, out: Cell): Cell => {
    const x = u * across;
    const y = v * along;
    const i = Math.floor(x);
    const j = Math.floor(y);
    let nearest = 1e9;
    let second = 1e9;
    for (let cj = j - 1; cj <= j + 1; cj += 1) {
      const line = wrapped(cj, along) * across;
      for (let ci = i - 1; ci <= i + 1; ci += 1) {
        const at = line + wrapped(ci, across);
        const dx = x - ci - middles[2 * at]!;
        const dy = y - cj - middles[2 * at + 1]!;
        const distance = dx * dx + dy * dy;
        if (distance < nearest) {
          second = nearest;
          nearest = distance;
          out.across = dx;
          out.along = dy;
          out.chance = chances[at]!;
        } else if (distance < second) {
          second = distance;
        }
      }
    }
    out.nearest = Math.sqrt(nearest);
    out.second = Math.sqrt(second);
    return out;
  };
}

/** An empty `Cell` to be written into. */
export function noCell(): Cell {
  return { nearest: 0, second: 0, across: 0, along: 0, chance: 0 };
}

/** 0 below `low`, 1 above `high`, and a smooth curve between. */
export function step(low: number, high: number, value: number): number {
  const t = Math.min(1, Math.max(0, (value - low) / (high - low)));
  return t * t * (3 - 2 * t);
}

function wrapped(index: number, period: number): number {
  const rest = index % period;
  return rest < 0 ? rest + period : rest;
}

function chanceOf(at: number, seed: number): number {
  return leafHash(at + Math.imul(seed, 0x9e3779b1)) / 2 ** 32;
}
