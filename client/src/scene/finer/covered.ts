import { type Mesh, type Object3D, Vector3 } from "three";
import { leafHash } from "../leaf-hash";

/** Of what reaches below one height and above the other, in internodes, the ground is covered. */
const HIGH = 0.45;
const LOW = -0.3;
/** Grass keeps this far from its edge, in squares. */
const KEEPS = 0.6;

/** From a square to those beside it: columns and lines. */
const AROUND = [
  [1, 0],
  [-1, 0],
  [0, 1],
  [0, -1],
] as const;

/** The squares of the ground in which something lies: for each line the first and the last column of each run of them. */
export class Covered {
  /** Runs in order, none of which touches the next. A large floor covers millions of squares, and few runs. */
  private readonly lines = new Map<number, readonly number[]>();

  /** What bodies cover of squares so wide. */
  static under(bodies: readonly Object3D[], side: number): Covered {
    const runs = new Map<number, number[]>();
    const corners = [new Vector3(), new Vector3(), new Vector3()] as const;
    for (const { geometry, matrixWorld } of bodies as readonly Mesh[]) {
      const { position } = geometry.attributes;
      const index = geometry.getIndex();
      if (!position || !index) continue;
      for (let at = 0; at < index.count; at += 3) {
        for (const [n, corner] of corners.entries()) {
          corner.fromBufferAttribute(position, index.getX(at + n)).applyMatrix4(matrixWorld);
        }
        const heights = corners.map(({ y }) => y);
        if (Math.min(...heights) < HIGH && Math.max(...heights) > LOW) addRuns(runs, corners, side);
      }
    }
    const covered = new Covered();
    for (const [line, found] of runs) covered.lines.set(line, joined(found));
    return covered;
  }

  /** How many squares. */
  get size(): number {
    let size = 0;
    for (const runs of this.lines.values()) {
      for (let at = 0; at < runs.length; at += 2) size += runs[at + 1]! - runs[at]! + 1;
    }
    return size;
  }

  /** Whether something lies in a square. */
  has(column: number, line: number): boolean {
    const runs = this.lines.get(line);
    if (!runs) return false;
    let [low, high] = [0, runs.length >> 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (runs[2 * middle + 1]! < column) low = middle + 1;
      else high = middle;
    }
    return 2 * low < runs.length && runs[2 * low]! <= column;
  }

  /** Whether no grass grows in a square: over an edge that lies low it does here and there, and a few tufts behind it. */
  isBare(column: number, line: number): boolean {
    if (!this.has(column, line)) return false;
    const chance = leafHash(column * 65_536 + line) & 255;
    if (chance < 70) return true;
    const isBeside = (column: number, line: number) => AROUND.some(([dx, dz]) => !this.has(column + dx, line + dz));
    if (isBeside(column, line)) return false;
    return chance < 200 || !AROUND.some(([dx, dz]) => isBeside(column + dx, line + dz));
  }
}

/** Runs of columns in order, those that touch each other as one. */
function joined(runs: readonly number[]): readonly number[] {
  const order = Array.from({ length: runs.length / 2 }, (_, at) => 2 * at).sort((a, b) => runs[a]! - runs[b]!);
  const joined: number[] = [];
  for (const at of order) {
    const last = joined.length - 1;
    if (last > 0 && runs[at]! <= joined[last]! + 1) joined[last] = Math.max(joined[last]!, runs[at + 1]!);
    else joined.push(runs[at]!, runs[at + 1]!);
  }
  return joined;
}

/** Adds, line by line, the squares whose middles lie in a triangle seen from above, or hardly outside it. */
function addRuns(runs: Map<number, number[]>, corners: readonly [Vector3, Vector3, Vector3], side: number): void {
  const x = corners.map((corner) => corner.x / side) as [number, number, number];
  const z = corners.map((corner) => corner.z / side) as [number, number, number];
  const area = (x[1] - x[0]) * (z[2] - z[0]) - (x[2] - x[0]) * (z[1] - z[0]);
  if (Math.abs(area) < 1e-6) return;
  const turn = Math.sign(area);
  const [near, far] = [Math.floor(Math.min(...z) - KEEPS), Math.floor(Math.max(...z) + KEEPS)];
  for (let line = near; line <= far; line += 1) {
    let [from, to] = [Math.floor(Math.min(...x) - KEEPS), Math.floor(Math.max(...x) + KEEPS)];
    for (let a = 0; a < 3; a += 1) {
      const b = (a + 1) % 3;
      const [dx, dz] = [turn * (x[b]! - x[a]!), turn * (z[b]! - z[a]!)];
      // Inside is where dx (line + 0.5 - z) - dz (column + 0.5 - x) is not below -KEEPS times the length of the edge.
      const room = dx * (line + 0.5 - z[a]!) + KEEPS * Math.hypot(dx, dz);
      const crossing = x[a]! - 0.5 + room / dz;
      if (dz > 0) to = Math.min(to, Math.floor(crossing));
      else if (dz < 0) from = Math.max(from, Math.ceil(crossing));
      else if (room < 0) to = from - 1;
    }
    if (from > to) continue;
    const ofLine = runs.get(line);
    if (ofLine) ofLine.push(from, to);
    else runs.set(line, [from, to]);
  }
}
