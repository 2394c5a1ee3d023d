import type { ChunkChange, Frame, Rows } from "../src/wire/frame";
import { CHUNK_ROWS, MIN_RADIUS, POSITION_STEPS, RADIUS_LOG_STEP } from "../src/wire/generated";
import { randoms } from "./randoms";

/** What a sample tree should be like. */
export interface SampleOptions {
  seed: number;
  /** Metamers of the trunk. */
  height: number;
  /** How often axes branch again. */
  orders: number;
}

interface Metamer {
  parent: number;
  begins: boolean;
  at: number[];
  order: number;
}

/** A plausible branching tree as one catch-up frame: a stand-in for the server where only the picture matters. */
export function sampleTree({ seed, height, orders }: SampleOptions): Frame {
  const random = randoms(seed);
  const metamers: Metamer[] = [{ parent: -1, begins: false, at: [0, 0, 0], order: 0 }];
  const queue = [{ from: 0, heading: [0.02, 1, 0.03], length: height, order: 0 }];
  for (let axis = queue.shift(); axis; axis = queue.shift()) {
    let { from, heading } = axis;
    let azimuth = random() * 6.28;
    for (let i = 0; i < axis.length; i += 1) {
      const wander = axis.order === 0 ? 0.1 : 0.2;
      const lift = axis.order === 0 ? 0.05 : 0.035;
      heading = unit(heading.map((h, a) => h + wander * (random() - 0.5) * 2 + (a === 1 ? lift : 0)));
      const base = metamers[from]!.at;
      metamers.push({
        parent: from,
        begins: i === 0 && axis.order > 0,
        at: base.map((b, a) => b + heading[a]!),
        order: axis.order,
      });
      from = metamers.length - 1;
      azimuth += 2.4;
      const share = i / axis.length;
      const bears = axis.order === 0 ? share > 0.22 : share > 0.12;
      if (!bears || axis.order >= orders || random() < (axis.order === 0 ? 0.25 : 0.4)) continue;
      const length = Math.round(
        axis.order === 0
          ? height * 0.62 * Math.sin(Math.PI * (0.18 + 0.74 * share)) ** 0.8 * (0.7 + 0.5 * random())
          : (axis.length - i) * 0.62 * (0.6 + 0.6 * random()),
      );
      if (length >= 1) queue.push({ from, heading: aside(heading, azimuth, 0.95), length, order: axis.order + 1 });
    }
  }
  return asFrame(metamers, random);
}

function aside(heading: number[], azimuth: number, angle: number): number[] {
  const helper = Math.abs(heading[1]!) < 0.9 ? [0, 1, 0] : [1, 0, 0];
  const u = unit(cross(heading, helper));
  const w = cross(heading, u);
  return unit(
    heading.map(
      (h, a) => h * Math.cos(angle) + (u[a]! * Math.cos(azimuth) + w[a]! * Math.sin(azimuth)) * Math.sin(angle),
    ),
  );
}

function asFrame(metamers: Metamer[], random: () => number): Frame {
  const n = metamers.length;
  const power = new Float64Array(n);
  for (let row = n - 1; row > 0; row -= 1) {
    if (power[row] === 0) power[row] = 0.05 ** 2.5;
    power[metamers[row]!.parent]! += power[row]!;
  }
  const centre = [0, 1, 2].map((a) => metamers.reduce((sum, m) => sum + m.at[a]!, 0) / n);
  const spread = Math.sqrt(metamers.reduce((sum, m) => sum + distance2(m.at, centre), 0) / n);
  const quantised = metamers.map((m) => m.at.map((x) => Math.round(x * POSITION_STEPS)));
  const changes: ChunkChange[] = [];
  for (let first = 0; first < n; first += CHUNK_ROWS) {
    const count = Math.min(CHUNK_ROWS, n - first);
    const rows: Rows = {
      parent: new Uint32Array(count),
      position: new Int32Array(3 * count),
      radius: new Uint16Array(count),
      foliage: new Uint8Array(count),
      light: new Uint8Array(count),
      born: new Uint32Array(count),
    };
    for (let i = 0; i < count; i += 1) {
      const row = first + i;
      const { parent, begins, at } = metamers[row]!;
      const radius = power[row]! ** 0.4;
      rows.parent[i] = parent < 0 ? 0 : 2 * (row - parent) + (begins ? 1 : 0);
      for (let a = 0; a < 3; a += 1) {
        rows.position[3 * i + a] = quantised[row]![a]! - (parent < 0 ? 0 : quantised[parent]![a]!);
      }
      rows.radius[i] = parent < 0 ? 0 : 1 + Math.round(Math.log(radius / MIN_RADIUS) / RADIUS_LOG_STEP);
      const outer = Math.min(
        1,
        (Math.sqrt(distance2(at, centre)) / spread) * 0.6 + Math.max(0, at[1]! - centre[1]!) * 0.03,
      );
      rows.foliage[i] = radius < 0.085 ? 3 | (Math.floor(16 * Math.min(0.99, 0.3 + 0.6 * outer * random())) << 4) : 0;
      rows.light[i] = Math.round(255 * (0.15 + 0.85 * outer));
      // A crown grows by about as much in each step, for it is thicker the longer it grows.
      rows.born[i] = parent < 0 ? 0 : 1 + Math.floor((20 * row) / n);
    }
    changes.push({ change: "replace", chunk: first / CHUNK_ROWS, generation: 1, rows });
  }
  return { epoch: 1, sequence: 1, catchUp: true, changes };
}

function unit(v: number[]): number[] {
  const length = Math.hypot(...v);
  return v.map((x) => x / length);
}

function cross(a: number[], b: number[]): number[] {
  return [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
}

function distance2(a: number[], b: number[]): number {
  return a.reduce((sum, x, i) => sum + (x - b[i]!) ** 2, 0);
}
