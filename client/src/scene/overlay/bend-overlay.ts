import { updateOrientation } from "../table/node-orientations";
import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import { type Overlay, type Rotation, rotated, type SlotAssignment, type SlotWriter } from "./overlays";

/** How an internode has moved: places go to rotation · (place − its end) + to. */
export interface RowMotion {
  readonly row: number;
  readonly rotation: Rotation;
  /** Where its end is now. */
  readonly to: Vec3;
}

/** A path that is bent or turned: its rows move one by one, and every branch with the row that bears it. */
export class BendOverlay implements Overlay {
  readonly slots: number;
  readonly path: readonly number[];
  private readonly index = new Map<number, number>();
  private readonly rest: Vec3[];
  private rotations: Rotation[];
  private ends: Vec3[];
  /** The path as it is drawn, in rows of its own: the nodes' orientations follow from it. */
  private readonly skeleton: Chain;

  /** `path` goes upwards, each row the child of the one before. */
  constructor(table: TreeTable, path: readonly number[]) {
    this.path = [...path];
    this.slots = path.length;
    this.rest = path.map((row) => placeOf(table, row));
    this.rotations = path.map(() => [0, 0, 0, 1]);
    this.ends = [...this.rest];
    for (const [i, row] of path.entries()) this.index.set(row, i);
    this.skeleton = new Chain(table, path);
  }

  /** Moves the path's internodes; rows that are not on it are left out. */
  move(motions: Iterable<RowMotion>): void {
    for (const { row, rotation, to } of motions) {
      const i = this.index.get(row);
      if (i === undefined) continue;
      this.rotations[i] = rotation;
      this.ends[i] = to;
    }
    this.skeleton.move(this.rotations, this.ends);
  }

  /** Whether this is the way from the same base to the same end. */
  follows(path: readonly number[]): boolean {
    return path.length === this.path.length && path.every((row, i) => row === this.path[i]);
  }

  *assignments(): Iterable<SlotAssignment> {
    for (const [i, row] of this.path.entries()) yield { row, slot: i, own: true, above: i };
  }

  write(_table: TreeTable, out: SlotWriter): void {
    for (let i = 0; i < this.path.length; i += 1) {
      out.plain(i);
      out.motion(i, this.rotations[i]!, this.rest[i]!, this.ends[i]!);
      out.orientation(i, this.skeleton.orientations, i + 1);
    }
  }

  /** The table has the committed places, or the branch is gone. */
  over(table: TreeTable): boolean {
    return this.path.some((row, i) => {
      if (row >= table.rows || table.radiusCode[row] === 0) return true;
      const [x, y, z] = this.rest[i]!;
      const { position } = table;
      return position[3 * row] !== x || position[3 * row + 1] !== y || position[3 * row + 2] !== z;
    });
  }
}

/** A path as it is drawn: 0 for the node that bears it, then its own. */
class Chain {
  readonly position: Float32Array;
  readonly across: Float32Array;
  readonly parent: Int32Array;
  readonly startsAxis: Uint8Array;
  readonly orientations: Float32Array;
  /** From each of its nodes to where that is drawn, and across which its ring lies there, both at rest. */
  private readonly asides: Vec3[];
  private readonly ways: Vec3[];
  /** How its limb goes on from each node and is not part of the path, and the mean of how it comes and goes, both at rest. */
  private readonly leaves: (Vec3 | null)[];
  private readonly means: Vec3[];
  /** Whether the next row of the path is how it goes on. */
  private readonly goesOn: boolean[];

  constructor(table: TreeTable, path: readonly number[]) {
    const count = 1 + path.length;
    const { placed, across } = table.course;
    this.position = new Float32Array(3 * count);
    this.across = new Float32Array(3 * count);
    this.parent = Int32Array.from({ length: count }, (_, i) => i - 1);
    this.startsAxis = new Uint8Array(count);
    this.orientations = new Float32Array(4 * count);
    this.asides = path.map((row) => difference(vectorOf(placed, row), placeOf(table, row)));
    this.ways = path.map((row) => vectorOf(across, row));
    this.leaves = path.map((row, i) => {
      const next = table.limbs.onward[row]!;
      return next < 0 || next === path[i + 1] ? null : difference(vectorOf(placed, next), vectorOf(placed, row));
    });
    const below = table.parent[path[0] ?? 0] ?? -1;
    if (below >= 0) {
      this.position.set(vectorOf(placed, below));
      this.across.set(vectorOf(across, below));
      this.orientations.set(table.orientations.subarray(4 * below, 4 * below + 4));
      // The node below a seed has no orientation to continue from.
      this.parent[0] = table.parent[below]! < 0 ? -1 : 0;
    } else {
      this.parent[1] = -1;
    }
    for (const [i, row] of path.entries()) this.startsAxis[i + 1] = table.limbs.begins[row]!;
    this.goesOn = path.map((row, i) => table.limbs.onward[row] === path[i + 1]);
    for (const [i, row] of path.entries()) this.position.set(vectorOf(placed, row), 3 * (i + 1));
    this.means = path.map((_, i) => this.meanAt(i, [0, 0, 0, 1]));
    for (const [i, way] of this.ways.entries()) this.across.set(way, 3 * (i + 1));
    for (let i = 1; i <= path.length; i += 1) updateOrientation(this, this.orientations, i);
  }

  /** Brings places and orientations to where these motions have them. */
  move(rotations: readonly Rotation[], ends: readonly Vec3[]): void {
    const count = rotations.length;
    for (let i = 0; i < count; i += 1) {
      const [x, y, z] = rotated(rotations[i]!, this.asides[i]!);
      const end = ends[i]!;
      this.position.set([end[0] + x, end[1] + y, end[2] + z], 3 * (i + 1));
    }
    for (let i = 0; i < count; i += 1) {
      const swing = between(this.means[i]!, this.meanAt(i, rotations[i]!));
      this.across.set(rotated(swing, this.ways[i]!), 3 * (i + 1));
    }
    for (let i = 1; i <= count; i += 1) updateOrientation(this, this.orientations, i);
  }

  /** The mean of how a limb comes to a node and goes on, which its row turns like this. */
  private meanAt(i: number, rotation: Rotation): Vec3 {
    const here = vectorOf(this.position, i + 1);
    const comes = this.parent[i + 1]! < 0 ? null : difference(here, vectorOf(this.position, i));
    const aside = this.leaves[i]!;
    const next = this.goesOn[i] ? difference(vectorOf(this.position, i + 2), here) : null;
    return unit(sum(unit(comes ?? [0, 0, 0]), unit((aside && rotated(rotation, aside)) ?? next ?? [0, 0, 0])));
  }
}

/** The shortest rotation from one direction to another. */
function between(a: Vec3, b: Vec3): Rotation {
  const w = 1 + a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const [x, y, z] = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const length = Math.hypot(x, y, z, w);
  return length < 1e-6 ? [0, 0, 0, 1] : [x / length, y / length, z / length, w / length];
}

/** Of length 1, or of none. */
function unit(v: Vec3): Vec3 {
  const length = Math.hypot(...v);
  return length < 1e-6 ? [0, 0, 0] : [v[0] / length, v[1] / length, v[2] / length];
}

function sum(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

function difference(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function placeOf({ position }: TreeTable, row: number): Vec3 {
  return vectorOf(position, row);
}

function vectorOf(of: Float32Array, row: number): Vec3 {
  return [of[3 * row]!, of[3 * row + 1]!, of[3 * row + 2]!];
}
