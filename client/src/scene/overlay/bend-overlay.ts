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
  /** The path with what stands around it, in rows of its own: the nodes' orientations follow from it. */
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
    this.skeleton.move(this.rotations, this.rest, this.ends);
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

/** The nodes of a path: 0 for the one that bears it, then its own, then those with which limbs leave it for good. */
class Chain {
  readonly position: Float32Array;
  readonly parent: Int32Array;
  readonly successor: Int32Array;
  readonly startsAxis: Uint8Array;
  readonly orientations: Float32Array;
  private readonly asideRest: { readonly from: number; readonly place: Vec3 }[] = [];

  constructor(
    table: TreeTable,
    private readonly path: readonly number[],
  ) {
    const asides = path.map((row, i) => {
      const next = table.limbs.onward[row]!;
      return next >= 0 && next !== path[i + 1] ? next : -1;
    });
    const count = 1 + path.length + asides.filter((next) => next >= 0).length;
    this.position = new Float32Array(3 * count);
    this.parent = new Int32Array(count).fill(-1);
    this.successor = new Int32Array(count).fill(-1);
    this.startsAxis = new Uint8Array(count);
    this.orientations = new Float32Array(4 * count);
    const below = table.parent[path[0] ?? 0] ?? -1;
    if (below >= 0) {
      this.position.set(placeOf(table, below));
      this.orientations.set(table.orientations.subarray(4 * below, 4 * below + 4));
      // The node below a seed has no orientation to continue from.
      this.parent[0] = table.parent[below]! < 0 ? -1 : 0;
    }
    let aside = 1 + path.length;
    for (const [i, row] of path.entries()) {
      this.parent[i + 1] = below < 0 && i === 0 ? -1 : i;
      this.startsAxis[i + 1] = table.limbs.begins[row]!;
      this.position.set(placeOf(table, row), 3 * (i + 1));
      const next = asides[i]!;
      if (next < 0) {
        if (table.limbs.onward[row] === path[i + 1] && i + 1 < path.length) this.successor[i + 1] = i + 2;
        continue;
      }
      this.successor[i + 1] = aside;
      this.parent[aside] = i + 1;
      this.asideRest.push({ from: i, place: placeOf(table, next) });
      this.position.set(placeOf(table, next), 3 * aside);
      aside += 1;
    }
    for (let i = 1; i <= path.length; i += 1) updateOrientation(this, this.orientations, i);
  }

  /** Brings places and orientations to where these motions have them. */
  move(rotations: readonly Rotation[], rest: readonly Vec3[], ends: readonly Vec3[]): void {
    const { length } = this.path;
    for (const [i, end] of ends.entries()) this.position.set(end, 3 * (i + 1));
    for (const [k, { from, place }] of this.asideRest.entries()) {
      const [base, end] = [rest[from]!, ends[from]!];
      const [x, y, z] = rotated(rotations[from]!, [place[0] - base[0], place[1] - base[1], place[2] - base[2]]);
      this.position.set([x + end[0], y + end[1], z + end[2]], 3 * (1 + length + k));
    }
    for (let i = 1; i <= length; i += 1) updateOrientation(this, this.orientations, i);
  }
}

function placeOf({ position }: TreeTable, row: number): Vec3 {
  return [position[3 * row]!, position[3 * row + 1]!, position[3 * row + 2]!];
}
