import { type ChunkChange, type Frame, FrameError, type Rows } from "../../wire/frame";
import { CHUNK_ROWS, MIN_RADIUS, POSITION_STEPS, RADIUS_LOG_STEP } from "../../wire/generated";
import { byFrames, type Told } from "../../wire/told";
import { leafHash } from "../leaf-hash";
import { Bounds } from "./bounds";
import { Cascade } from "./cascade";
import { grown } from "./column";
import { Course } from "./course";
import { Girth } from "./girth";
import { Limbs } from "./limbs";
import { type Skeleton, updateOrientation } from "./node-orientations";

/** What changed in a row since the last `drain`. */
export const Dirty = {
  /** Something the GPU draws with: position, orientation, radius, light, birth. */
  Drawn: 1,
  /** Where its metamer runs, whether it lives, or how many leaves it bears. */
  Shape: 2,
} as const;

/** Numbers of an orientation that differ by less together are not worth to turn a whole tree's bark for. */
const UNSEEN_TURN = 0.03;
/** So many metamers of a trunk tell its tree from others. */
const TELLING = 3;
/** Births this far back mean that a row never eased in. */
const LONG_AGO = -1000;
/** Positions beyond this many internodes are not a tree; the server's limit is 1000 plus what grows past it. */
const MAX_QUANTISED = 1 << 22;
/** Rows at which the table refuses to grow: four times the largest document. */
const MAX_ROWS = 1 << 22;

/** Radii of codes that were asked for; a step in time asks for those of a whole tree. */
const RADII = new Float64Array(1 << 16);

/** Radius in internodes of a code; 0 for the dead. */
export function radiusOf(code: number): number {
  if (code !== 0 && RADII[code] === 0) RADII[code] = MIN_RADIUS * Math.exp((code - 1) * RADIUS_LOG_STEP);
  return RADII[code]!;
}

const NOTHING: Skeleton = {
  position: new Float32Array(0),
  across: new Float32Array(0),
  parent: new Int32Array(0),
  startsAxis: new Uint8Array(0),
};

/** The table of rows a session's frames build, with what drawing them needs derived. */
export class TreeTable {
  /** How many rows. */
  rows = 0;
  /** Epoch of the frames applied; 0 while there are none. */
  epoch = 0;
  /** Sequence of the last frame applied, or null. */
  sequence: number | null = null;

  /** Where each metamer ends, in internodes: x y z. */
  position = new Float32Array(0);
  /** The same in steps of 1/256 internode, exactly as sent. */
  quantised = new Int32Array(0);
  /** -1 for a seed. */
  parent = new Int32Array(0);
  /** 1 where a row begins an axis. */
  startsAxis = new Uint8Array(0);
  /** Radius codes; 0 is dead or a seed. */
  radiusCode = new Uint16Array(0);
  /** Leaves in the low four bits, vigor in the high four. */
  foliage = new Uint8Array(0);
  /** Exposure 0 to 255. */
  light = new Uint8Array(0);
  /** The step of growth in which each metamer was born; 0 for the first seed. */
  born = new Uint32Array(0);
  /** Organs that rows are given (LF5); a row that is not in it bears what grows on such wood. */
  readonly organs = new Map<number, Uint32Array>();
  /** The living row that continues the axis, or -1. */
  successor = new Int32Array(0);
  /** The orientation of each node as a quaternion, x y z w with w ≥ 0. */
  orientations = new Float32Array(0);
  /** Which rows are one limb, as it is drawn. */
  readonly limbs = new Limbs();
  /** How thick they are drawn. */
  readonly girth = new Girth();
  /** Where they are drawn. */
  readonly course = new Course();
  /** Length along the limb's nodes from where it begins, in internodes. */
  arc = new Float32Array(0);
  /** The row at which the limb begins, which belongs to the limb that bears it. */
  limbOrigin = new Int32Array(0);
  /** When each row begins to grow, in seconds of `now`. */
  birth = new Float32Array(0);
  /** How long it takes to grow. */
  growing = new Float32Array(0);

  /** When the last row will have finished growing. */
  settledAt = LONG_AGO;

  private readonly chunkGenerations: number[] = [];
  private readonly dirty: { bits: Uint8Array; chunks: Set<number>; lowWater: number } = {
    bits: new Uint8Array(0),
    chunks: new Set(),
    lowWater: 0,
  };
  private staleOrientations = new Uint8Array(0);
  private moved = new Uint8Array(0);
  /** Which of those turn with the node below them alone. */
  private follows = new Uint8Array(0);
  private firstStale = Number.POSITIVE_INFINITY;
  /** What orientations are computed from: limbs as they are drawn. */
  private drawn: Skeleton = NOTHING;
  private readonly extent = new Bounds();
  /** Numbers of trees by the rows of their seeds, once all that tells them is there. */
  private readonly numbers = new Map<number, number>();
  private readonly start: number;
  /** Where a row ends, seen from where its parent does, while it is read. */
  private readonly way = new Int32Array(3);

  constructor(
    private readonly clock: () => number = () => performance.now() / 1000,
    private readonly told: Told = byFrames,
  ) {
    this.start = clock();
  }

  /** Seconds since the table was made; small enough for 32-bit floats. */
  now(): number {
    return this.clock() - this.start;
  }

  /** The generation of each chunk, for `resume` (RS1). */
  generations(): number[] {
    return [...this.chunkGenerations];
  }

  /** The box around all living rows and seeds. */
  bounds(): Bounds {
    this.extent.refresh(this);
    return this.extent;
  }

  /** Visits the living rows that grow from a node. */
  eachChild(node: number, visit: (row: number) => void): void {
    if (this.successor[node]! >= 0) visit(this.successor[node]!);
    this.limbs.eachLateral(node, visit);
  }

  /** How far trunks spread at their feet, and whether wood is drawn without corners; says whether rows change by it. */
  shape(flare: number, rounded: boolean): boolean {
    if (!this.course.shape(flare, rounded)) return false;
    this.derive();
    return true;
  }

  /** The radius in internodes that the server has for a row; 0 for the dead, and a seed has its trunk's. */
  radiusOf(row: number): number {
    const sown = this.parent[row]! < 0 ? this.successor[row]! : row;
    return sown < 0 ? 0 : radiusOf(this.radiusCode[sown]!);
  }

  /**
   * What a tree has by chance follows from this number below 2²⁴, by the row of its seed. It comes of how the trunk begins,
   * so that it is the same wherever the tree is shown; as long as a page is open it stays when the trunk is bent.
   */
  numberOf(seed: number): number {
    const known = this.numbers.get(seed);
    if (known !== undefined) return known;
    let [number, row] = [0, seed];
    for (let told = 0; told <= TELLING && row >= 0; told += 1) {
      for (let axis = 0; axis < 3; axis += 1) number = leafHash((number + this.quantised[3 * row + axis]!) >>> 0);
      if (told === TELLING) this.numbers.set(seed, number >>> 8);
      row = this.successor[row]!;
    }
    return number >>> 8;
  }

  /** Forgets every row and the epoch. */
  clear(): void {
    this.truncate(0);
    this.epoch = 0;
    this.sequence = null;
    this.settledAt = LONG_AGO;
  }

  /** Applies a frame; one that does not fit throws `FrameError`, and the table must then be cleared (FR1). */
  apply(frame: Frame): void {
    if (this.epoch !== 0 && frame.epoch !== this.epoch) {
      throw new FrameError(`A frame of epoch ${frame.epoch} does not fit rows of epoch ${this.epoch}.`);
    }
    if (!frame.catchUp && this.sequence !== null && frame.sequence !== (this.sequence + 1) % 2 ** 32) {
      throw new FrameError(`Frame ${frame.sequence} does not follow frame ${this.sequence}.`);
    }
    const cascade = new Cascade(this.rows);
    this.reserve(rowsAfter(frame, this.rows));
    for (const change of frame.changes) {
      this.change(change, frame.sequence);
      cascade.shrinkTo(this.rows);
    }
    this.epoch = frame.epoch;
    this.sequence = frame.sequence;
    this.giveBirth(cascade.firstNew, frame.catchUp);
    this.derive();
  }

  /**
   * Hands over what changed since the last call: first how many of the old rows survived, then each changed row
   * with its `Dirty` bits, in ascending order within a chunk.
   */
  drain(survived: (rows: number) => void, changed: (row: number, bits: number) => void): void {
    const { bits, chunks } = this.dirty;
    survived(this.dirty.lowWater);
    for (const chunk of chunks) {
      const end = Math.min(this.rows, (chunk + 1) * CHUNK_ROWS);
      for (let row = chunk * CHUNK_ROWS; row < end; row += 1) {
        const what = bits[row]!;
        if (what === 0) continue;
        bits[row] = 0;
        changed(row, what);
      }
    }
    chunks.clear();
    this.dirty.lowWater = this.rows;
  }

  private change(change: ChunkChange, sequence: number): void {
    switch (change.change) {
      case "truncate":
        if (change.rows > this.rows) throw new FrameError("A truncation keeps more rows than there are.");
        this.truncate(change.rows);
        if (change.rows % CHUNK_ROWS !== 0) this.chunkGenerations[this.chunkGenerations.length - 1] = sequence;
        return;
      case "replace":
        this.replace(change.chunk, change.rows);
        break;
      case "append": {
        const first = change.chunk * CHUNK_ROWS + change.start;
        if (first !== this.rows) throw new FrameError(`An append to row ${first} does not fit ${this.rows} rows.`);
        this.write(first, change.rows);
        break;
      }
      case "patch":
        this.patch(change);
        break;
    }
    this.chunkGenerations[change.chunk] = change.generation;
  }

  private truncate(rows: number): void {
    if (rows >= this.rows) return;
    for (let row = rows; row < this.rows; row += 1) {
      const parent = this.parent[row]!;
      if (parent < 0 || parent >= rows) continue;
      if (this.successor[parent] === row) this.setSuccessor(parent, -1);
      this.limbs.leave(row);
    }
    for (const row of this.organs.keys()) if (row >= rows) this.organs.delete(row);
    this.dirty.bits.fill(0, rows, this.rows);
    this.staleOrientations.fill(0, rows, this.rows);
    this.rows = rows;
    this.dirty.lowWater = Math.min(this.dirty.lowWater, rows);
    this.chunkGenerations.length = Math.ceil(rows / CHUNK_ROWS);
    this.extent.invalidate();
  }

  private replace(chunk: number, rows: Rows): void {
    const first = chunk * CHUNK_ROWS;
    const end = first + rows.parent.length;
    if (first > this.rows) throw new FrameError(`Chunk ${chunk} would leave a gap behind ${this.rows} rows.`);
    if (this.rows > first + CHUNK_ROWS && end < first + CHUNK_ROWS) {
      throw new FrameError(`Chunk ${chunk} is not the last, so it must be full.`);
    }
    if (this.rows > end && this.rows <= first + CHUNK_ROWS) this.truncate(end);
    this.write(first, rows);
    this.extent.invalidate();
  }

  private write(first: number, rows: Rows): void {
    const end = first + rows.parent.length;
    this.reserve(end);
    const known = this.rows;
    this.rows = Math.max(this.rows, end);
    for (let i = 0; i < rows.parent.length; i += 1) {
      const row = first + i;
      if (row >= known) this.welcome(row);
      else this.unlink(row);
      this.setParent(row, rows.parent[i]!);
      this.setPosition(row, rows.position, 3 * i);
      this.radiusCode[row] = rows.radius[i]!;
      this.foliage[row] = rows.foliage[i]!;
      this.light[row] = rows.light[i]!;
      this.born[row] = rows.born[i]!;
      this.organs.delete(row);
      if (row >= known) this.birth[row] = LONG_AGO;
      this.link(row);
      this.mark(row, Dirty.Drawn | Dirty.Shape);
    }
  }

  private welcome(row: number): void {
    this.successor[row] = -1;
    this.limbs.welcome(row);
  }

  private patch(change: Extract<ChunkChange, { change: "patch" }>): void {
    const first = change.chunk * CHUNK_ROWS;
    for (let i = 0; i < change.rows.length; i += 1) {
      const row = first + change.rows[i]!;
      if (row >= this.rows) throw new FrameError(`A patch of row ${row} does not fit ${this.rows} rows.`);
      switch (change.column) {
        case "parent":
          this.unlink(row);
          this.setParent(row, change.values[i]!);
          this.link(row);
          this.mark(row, Dirty.Drawn | Dirty.Shape);
          break;
        case "position":
          this.setPosition(row, change.values, 3 * i);
          this.extent.invalidate();
          this.mark(row, Dirty.Drawn | Dirty.Shape);
          break;
        case "radius":
          this.setRadius(row, this.told.radius(this.radiusCode[row]!, change.values[i]!));
          break;
        case "foliage":
          this.foliage[row] = this.told.foliage(this.foliage[row]!, change.values[i]!);
          this.mark(row, Dirty.Drawn | Dirty.Shape);
          break;
        case "light":
          this.light[row] = this.told.light(this.light[row]!, change.values[i]!);
          this.mark(row, Dirty.Drawn);
          break;
        case "organs":
          if (change.values[i] === null) this.organs.delete(row);
          else this.organs.set(row, change.values[i]!);
          this.mark(row, Dirty.Drawn | Dirty.Shape);
          break;
        case "born":
          this.born[row] = change.values[i]!;
          this.mark(row, Dirty.Drawn);
          break;
      }
    }
  }

  private setRadius(row: number, code: number): void {
    const before = this.radiusCode[row]!;
    this.radiusCode[row] = code;
    this.girth.touch(row);
    this.limbs.touch(row);
    if (this.parent[row]! >= 0) this.limbs.touch(this.parent[row]!);
    if ((before === 0) === (code === 0)) {
      this.mark(row, Dirty.Drawn);
      return;
    }
    this.unlink(row);
    this.link(row);
    // What changed on the axis while a row was dead has passed it by.
    this.markStale(row);
    this.extent.invalidate();
    this.mark(row, Dirty.Drawn | Dirty.Shape);
  }

  private setParent(row: number, code: number): void {
    const parent = code === 0 ? -1 : row - (code >>> 1);
    if (code !== 0 && (parent < 0 || parent >= row)) {
      throw new FrameError(`The parent of row ${row} is not below it (FR5).`);
    }
    this.parent[row] = parent;
    this.startsAxis[row] = code & 1;
  }

  private setPosition(row: number, told: Int32Array, at: number): void {
    const { quantised, way } = this;
    const parent = this.parent[row]!;
    const below = parent < 0 ? -1 : this.parent[parent]!;
    for (let axis = 0; axis < 3; axis += 1) {
      way[axis] = below < 0 ? 0 : quantised[3 * parent + axis]! - quantised[3 * below + axis]!;
    }
    this.told.turn(way, told, at, this.startsAxis[row] === 0);
    for (let axis = 0; axis < 3; axis += 1) this.setCoordinate(row, parent, axis, way[axis]!);
    this.markStale(row);
    this.moved[row] = 1;
    this.limbs.touch(row);
    this.girth.touch(row);
    if (parent < 0) return;
    this.markStale(parent);
    this.limbs.touch(parent);
  }

  private setCoordinate(row: number, parent: number, axis: number, offset: number): void {
    const value = (parent < 0 ? 0 : this.quantised[3 * parent + axis]!) + offset;
    if (Math.abs(value) > MAX_QUANTISED) throw new FrameError(`Row ${row} is too far from the origin.`);
    this.quantised[3 * row + axis] = value;
    this.position[3 * row + axis] = value / POSITION_STEPS;
  }

  /** Makes a living row that continues its parent's axis known to the parent. */
  private link(row: number): void {
    const parent = this.parent[row]!;
    if (parent < 0 || this.radiusCode[row] === 0) return;
    // A seed has no axis of its own: what grows from it first continues it, whatever its flag says.
    if (this.startsAxis[row] === 0 || (this.parent[parent]! < 0 && this.successor[parent]! < 0)) {
      this.setSuccessor(parent, row);
    } else {
      this.limbs.bear(parent, row);
    }
  }

  private unlink(row: number): void {
    this.limbs.leave(row);
    const parent = this.parent[row]!;
    if (parent >= 0 && this.successor[parent] === row) this.setSuccessor(parent, -1);
  }

  private setSuccessor(row: number, successor: number): void {
    this.successor[row] = successor;
    this.renumber(row);
    this.limbs.touch(row);
    this.girth.touch(row);
    this.markStale(row);
    this.mark(row, Dirty.Drawn);
  }

  /** The trunk of a seed goes on otherwise from a row, which may tell its tree from others. */
  private renumber(row: number): void {
    let seed = row;
    for (let told = 1; this.parent[seed]! >= 0; told += 1) {
      const below = this.parent[seed]!;
      if (told === TELLING || this.successor[below] !== seed) return;
      seed = below;
    }
    this.numbers.delete(seed);
    this.mark(seed, Dirty.Drawn);
  }

  private markStale(row: number): void {
    this.staleOrientations[row] = 1;
    this.firstStale = Math.min(this.firstStale, row);
  }

  private mark(row: number, bits: number): void {
    const before = this.dirty.bits[row]!;
    if ((before & bits) === bits) return;
    this.dirty.bits[row] = before | bits;
    this.dirty.chunks.add(Math.floor(row / CHUNK_ROWS));
  }

  /** A child starts when its parent has finished; a whole cascade takes a quarter of a second. */
  private giveBirth(firstNew: number, atOnce: boolean): void {
    if (firstNew >= this.rows) return;
    if (atOnce) {
      this.birth.fill(LONG_AGO, firstNew, this.rows);
      this.growing.fill(0, firstNew, this.rows);
      return;
    }
    const last = Cascade.schedule(this.parent, firstNew, this.rows, this.now(), this.birth, this.growing);
    this.settledAt = Math.max(this.settledAt, last);
  }

  /** Brings limbs, arcs, girth, courses and orientations up to date, in row order so that parents come first. */
  private derive(): void {
    this.limbs.judge(this, (row) => {
      this.markStale(row);
      this.girth.touch(row);
      this.mark(row, Dirty.Drawn);
    });
    this.measureStale();
    this.girth.derive(this, (row) => {
      this.course.thicken(row);
      this.mark(row, Dirty.Drawn);
    });
    this.course.derive(this, (row) => {
      this.markStale(row);
      this.mark(row, Dirty.Drawn);
    });
    this.orient();
  }

  private measureStale(): void {
    const { moved, limbs, staleOrientations: stale } = this;
    const follow = (row: number) => {
      this.mark(row, Dirty.Drawn | Dirty.Shape);
      this.markStale(row);
    };
    for (let row = stale.indexOf(1, this.firstStale); row >= 0; row = stale.indexOf(1, row + 1)) {
      if (moved[row] === 1) {
        moved[row] = 0;
        this.eachChild(row, follow);
      }
      this.course.touch(row);
      if (!this.measure(row, this.parent[row]!)) continue;
      this.mark(row, Dirty.Drawn);
      this.girth.touch(row);
      if (limbs.onward[row]! >= 0) this.markStale(limbs.onward[row]!);
    }
  }

  private orient(): void {
    const { drawn, orientations, follows, staleOrientations: stale } = this;
    // A lateral's orientation follows from the one of the node that bears it.
    const follow = (row: number) => {
      if (stale[row] === 1) return;
      stale[row] = 1;
      follows[row] = 1;
    };
    for (let row = stale.indexOf(1, this.firstStale); row >= 0; row = stale.indexOf(1, row + 1)) {
      stale[row] = 0;
      const slack = follows[row] === 1 ? UNSEEN_TURN : undefined;
      follows[row] = 0;
      if (!updateOrientation(drawn, orientations, row, slack)) continue;
      this.mark(row, Dirty.Drawn);
      this.eachChild(row, follow);
    }
    this.firstStale = Number.POSITIVE_INFINITY;
  }

  private measure(row: number, parent: number): boolean {
    if (parent < 0) {
      this.arc[row] = 0;
      this.limbOrigin[row] = row;
      return false;
    }
    const { position } = this;
    const length = Math.hypot(
      position[3 * row]! - position[3 * parent]!,
      position[3 * row + 1]! - position[3 * parent + 1]!,
      position[3 * row + 2]! - position[3 * parent + 2]!,
    );
    const begins = this.limbs.begins[row] === 1 || this.parent[parent]! < 0;
    const arc = length + (begins ? 0 : this.arc[parent]!);
    const origin = begins ? parent : this.limbOrigin[parent]!;
    const changed = Math.abs(arc - this.arc[row]!) > 1e-3 || origin !== this.limbOrigin[row];
    this.arc[row] = arc;
    this.limbOrigin[row] = origin;
    return changed;
  }

  private reserve(rows: number): void {
    if (rows > MAX_ROWS) throw new FrameError(`${rows} rows are more than a document can have.`);
    if (rows <= this.parent.length) return;
    // Twice as many at least, so that a tree that grows on does not move each time.
    const capacity = Math.max(4 * CHUNK_ROWS, 2 * this.parent.length, Math.ceil(rows / CHUNK_ROWS) * CHUNK_ROWS);
    this.position = grown(this.position, 3 * capacity);
    this.quantised = grown(this.quantised, 3 * capacity);
    this.parent = grown(this.parent, capacity);
    this.startsAxis = grown(this.startsAxis, capacity);
    this.radiusCode = grown(this.radiusCode, capacity);
    this.foliage = grown(this.foliage, capacity);
    this.light = grown(this.light, capacity);
    this.born = grown(this.born, capacity);
    this.successor = grown(this.successor, capacity);
    this.orientations = grown(this.orientations, 4 * capacity);
    this.arc = grown(this.arc, capacity);
    this.limbOrigin = grown(this.limbOrigin, capacity);
    this.birth = grown(this.birth, capacity);
    this.growing = grown(this.growing, capacity);
    this.staleOrientations = grown(this.staleOrientations, capacity);
    this.moved = grown(this.moved, capacity);
    this.follows = grown(this.follows, capacity);
    this.dirty.bits = grown(this.dirty.bits, capacity);
    this.limbs.reserve(capacity);
    this.girth.reserve(capacity);
    this.course.reserve(capacity);
    const { placed: position, across } = this.course;
    this.drawn = { position, across, parent: this.parent, startsAxis: this.limbs.begins };
  }
}

/** How many rows there are at most once a frame has been applied to so many; never more than it brings along. */
function rowsAfter({ changes }: Frame, rows: number): number {
  let [end, brought] = [rows, 0];
  for (const change of changes) {
    if (change.change !== "replace" && change.change !== "append") continue;
    const first = change.chunk * CHUNK_ROWS + (change.change === "append" ? change.start : 0);
    const { length } = change.rows.parent;
    end = Math.max(end, first + length);
    brought += length;
  }
  return Math.min(end, rows + brought);
}
