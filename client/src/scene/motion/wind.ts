import { leafHash } from "../leaf-hash";
import type { Vec3 } from "../vector";
import { shareOfVariance } from "./spectrum";

/** Seconds after which a wind that blows on begins anew. */
export const LIVE_PERIOD = 600;
/** Bands of the slow swell, and where it ends, Hz. */
const SWELL = 4;
const SWELL_FROM = 1 / 600;
const SWELL_TO = 0.02;
/** Bands above the swell, and where they end, Hz. */
const GUSTS = 16;
const GUSTS_TO = 4;
/** Standard deviation along a fully turbulent wind as a share of its mean, and those across and upward as shares of it. */
export const INTENSITY = 0.5;
const SIZES = [1, 0.75, 0.5] as const;
/** Gusts travel at this share of the mean speed. */
const CONVECTION = 0.9;
/** Davenport's decay of coherence: exp(−c f Δ / U) for two places Δ apart across the wind. */
const DECAY = 10;
/** Where the mean speed is measured, m, and how it grows from the ground. */
const GAUGE = 10;
const PROFILE = 0.2;
const NEAR_GROUND = 0.15;
const TAU = 2 * Math.PI;

/** Where the speed of a line points: along the mean wind, level and across it, or across both. */
export type Direction = 0 | 1 | 2;

/** What the user sets. */
export interface Weather {
  /** Mean wind 10 m above the ground, m/s. */
  readonly velocity: Vec3;
  /** From 0, which is even, to 1. */
  readonly turbulence: number;
  /** Which gusts come. */
  readonly seed: number;
}

/** One spectral line. */
export interface Line {
  /** How many times it comes round in a period. */
  readonly harmonic: number;
  /** The same in Hz. */
  readonly frequency: number;
  /** Amplitude as a share of the mean speed. */
  readonly amplitude: number;
  readonly direction: Direction;
  /** Phase at the origin and time 0, radians. */
  readonly phase: number;
  /** Wave number, radians per metre. */
  readonly wave: Vec3;
}

/** u(x, t) = U p(y) (Û + Σ a d cos(2π f t − κ·x + φ)): a function of place and time. */
export interface Wind {
  /** Mean speed 10 m above the ground, m/s. */
  readonly speed: number;
  /** Seconds after which everything comes again. */
  readonly period: number;
  /** Along, across and upward. */
  readonly axes: readonly [Vec3, Vec3, Vec3];
  /** Slowest first. */
  readonly lines: readonly Line[];
}

/** A wind whose lines are multiples of 1/period, each once; slower ones are left out. */
export function windOf({ velocity, turbulence, seed }: Weather, period: number): Wind {
  const speed = Math.hypot(...velocity);
  const along: Vec3 = speed > 0 ? [velocity[0] / speed, velocity[1] / speed, velocity[2] / speed] : [1, 0, 0];
  const axes = axesAlong(along);
  const blows = speed > 0 && turbulence > 0;
  return { speed, period, axes, lines: blows ? linesOf({ speed, period, axes }, turbulence, seed) : [] };
}

/** The unit vectors along, across and upward of a wind that blows along a unit vector. */
export function axesAlong(along: Vec3): readonly [Vec3, Vec3, Vec3] {
  const size = Math.hypot(along[2], along[0]);
  const across: Vec3 = size > 0 ? [-along[2] / size, 0, along[0] / size] : [0, 0, 1];
  return [along, across, cross(across, along)];
}

function linesOf({ speed, period, axes }: Omit<Wind, "lines">, turbulence: number, seed: number): Line[] {
  const tones = tonesOf(speed, period);
  const whole = tones.reduce((sum, { share }) => sum + share, 0);
  const deviations = SIZES.map((size, direction) => {
    // The lines of each direction hold all of its variance, though they are but some of all lines.
    const held = tones.reduce((sum, { share }, at) => sum + (directionOf(at) === direction ? share : 0), 0);
    return INTENSITY * turbulence * size * Math.sqrt(whole / held);
  });
  return tones.map(({ harmonic, share }, at) => {
    const direction = directionOf(at);
    const frequency = harmonic / period;
    // Davenport's coherence is the characteristic function of Cauchy's distribution, here that of the plane.
    const near = 1 - unitOf(seed, at, 1);
    const spread = ((DECAY * frequency) / speed) * Math.sqrt(1 / (near * near) - 1);
    const turn = TAU * unitOf(seed, at, 2);
    const onward = (TAU * frequency) / (CONVECTION * speed);
    const [sideways, upward] = [spread * Math.cos(turn), spread * Math.sin(turn)];
    const wave = (axis: 0 | 1 | 2) => onward * axes[0][axis] + sideways * axes[1][axis] + upward * axes[2][axis];
    return {
      harmonic,
      frequency,
      amplitude: deviations[direction]! * Math.sqrt(2 * share),
      direction,
      phase: TAU * unitOf(seed, at, 0),
      wave: [wave(0), wave(1), wave(2)],
    };
  });
}

/** Mean speed at a height above the ground in metres, as a share of that at 10 m. */
export function profile(height: number): number {
  return Math.max(Math.max(height / GAUGE, 0) ** PROFILE, NEAR_GROUND);
}

/** How far a line has come round at a time in seconds, in radians; the same to the bit a period later. */
export function angleAt(harmonic: number, period: number, time: number): number {
  const periods = time / period;
  const turns = harmonic * (periods - Math.floor(periods));
  return TAU * (turns - Math.floor(turns));
}

/** Two lines in three point along the wind. */
function directionOf(line: number): Direction {
  return line % 6 === 2 ? 1 : line % 6 === 5 ? 2 : 0;
}

/** Harmonics of a period with the share of the variance that each stands for. */
function tonesOf(speed: number, period: number): { harmonic: number; share: number }[] {
  const band = (from: number, to: number, count: number, at: number): readonly [number, number] => {
    const ratio = Math.log(to / from);
    return [from * Math.exp((ratio * at) / count), from * Math.exp((ratio * (at + 1)) / count)];
  };
  const tones: { harmonic: number; share: number }[] = [];
  for (let at = 0; at < SWELL + GUSTS; at += 1) {
    const edges = at < SWELL ? band(SWELL_FROM, SWELL_TO, SWELL, at) : band(SWELL_TO, GUSTS_TO, GUSTS, at - SWELL);
    const harmonic = Math.floor(Math.sqrt(edges[0] * edges[1]) * period + 0.5);
    if (harmonic === 0) continue;
    const share = shareOfVariance(speed, edges);
    const last = tones.at(-1);
    if (last?.harmonic === harmonic) last.share += share;
    else tones.push({ harmonic, share });
  }
  return tones;
}

/** A number from 0 to 1, 1 left out, for a purpose of a line. */
function unitOf(seed: number, line: number, purpose: number): number {
  return leafHash((leafHash(seed) + 4 * line + purpose) >>> 0) / 2 ** 32;
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
