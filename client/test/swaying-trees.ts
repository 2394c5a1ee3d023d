import { readFileSync } from "node:fs";
import type { Weather } from "../src/scene/motion/wind";
import type { TreeTable } from "../src/scene/table/tree-table";
import type { Vec3 } from "../src/scene/vector";
import { CHUNK_ROWS, type PlacedShape, type Pose } from "../src/wire/generated";
import { PlainTable } from "./plain-table";

interface JointSample {
  first: number;
  node: number;
  parent: number;
  level: number;
  frequency: number;
  damping: number;
  drag: number;
  softness: number;
  compliance: number[];
  centre: Vec3;
  area: number;
  lowest: number;
}

interface WindSample extends Weather {
  period: number;
  axes: Vec3[];
  lines: { harmonic: number; amplitude: number; direction: number; phase: number; wave: Vec3 }[];
}

/** A tree with its joints and its sway as the server computes them. */
export interface SwayingTree {
  name: string;
  internodeLength: number;
  leafSize: number;
  suppleness: number;
  /** As frames carry them, but for positions, which are whole and not differences. */
  rows: { parent: number[]; position: number[]; radius: number[]; leaves: number[] };
  onward: [row: number, onward: number][];
  limbs: [first: number, node: number, level: number][];
  joints: JointSample[];
  riders: number[];
  rides: [row: number, weight: number, first: Vec3, second: Vec3][];
  wind: WindSample;
  shares: [row: number, share: number][];
  exposure: number[];
  /** The wind as it is set. */
  blows: { speed: number; direction: number; rise: number };
  /** What stands upwind of it; all meshes have these triangles. */
  obstacles: { standing: { shape: PlacedShape; pose: Pose }[]; positions: number[]; triangles: number[] };
  lee: [row: number, share: number][];
  inLee: number[];
  laden: {
    sag: Vec3[];
    snow: Vec3[];
    rain: Vec3[];
    loading: { sag: number; snow: number; rain: number };
    means: Vec3[];
  };
  answers: { damping: number; mean: Vec3; swing: number[] }[];
  change: { at: number; wind: WindSample };
  pluck: { joint: number; at: number; bend: Vec3 };
  stands: { time: number; bends: Vec3[]; nodes: [row: number, place: Vec3, turn: number[]][] }[];
}

/** What moves besides joints, as the server computes it. */
interface Flutters {
  noise: [along: number, seed: number, value: number][];
  quivers: [number: number, least: number, time: number, value: number][];
  leaves: {
    base: Vec3;
    direction: Vec3;
    side: Vec3;
    own: Vec3;
    lee: Vec3;
    much: number;
    snow: number;
    wet: number;
    air: number;
    time: number;
    turn: number[];
  }[];
}

const file = new URL("../../server/motion/golden/sway.json", import.meta.url);
const golden: { trees: SwayingTree[]; sampledJoints: number; flutters: Flutters } = JSON.parse(
  readFileSync(file, "utf8"),
);

export const SWAYING_TREES = golden.trees;
export const FLUTTERS = golden.flutters;
/** Of joints every so many are written down. */
export const SAMPLED_JOINTS = golden.sampledJoints;

/** Its rows as a table. */
export function tableOfSwaying({ rows }: SwayingTree): TreeTable {
  const table = new PlainTable(() => 0);
  const count = rows.parent.length;
  const changes = [];
  for (let first = 0, chunk = 0; first < count; first += CHUNK_ROWS, chunk += 1) {
    const end = Math.min(count, first + CHUNK_ROWS);
    const position = [];
    for (let row = first; row < end; row += 1) {
      const parent = rows.parent[row] === 0 ? -1 : row - (rows.parent[row]! >>> 1);
      for (let axis = 0; axis < 3; axis += 1) {
        position.push(rows.position[3 * row + axis]! - (parent < 0 ? 0 : rows.position[3 * parent + axis]!));
      }
    }
    changes.push({
      change: "replace",
      chunk,
      generation: 1,
      rows: {
        parent: Uint32Array.from(rows.parent.slice(first, end)),
        position: Int32Array.from(position),
        radius: Uint16Array.from(rows.radius.slice(first, end)),
        foliage: Uint8Array.from(rows.leaves.slice(first, end)),
        light: new Uint8Array(end - first),
        born: new Uint32Array(end - first),
      },
    } as const);
  }
  table.apply({ epoch: 1, sequence: 1, catchUp: true, changes });
  return table;
}
