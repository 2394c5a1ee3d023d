import { DataTexture, FloatType, NearestFilter, RGBAFormat } from "three";
import { grown } from "../table/column";
import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";

/** Rows that wear a guise are drawn otherwise than the table has them, until it has caught up or the guise is taken off. */
export interface Guise {
  /** How many slots it has; each says how some rows are drawn. */
  readonly slots: number;
  /** Which rows begin to wear what. */
  wearers(table: TreeTable): Iterable<Wearer>;
  /** Writes what its slots say, from the table as it is now. */
  write(table: TreeTable, out: SlotWriter): void;
  /** Whether the table has what the guise showed, or has lost what it was about. */
  over(table: TreeTable): boolean;
}

export interface Wearer {
  readonly row: number;
  /** The slot the row itself wears. */
  readonly wears: number;
  /** Whether that slot has a frame and a radius for just this row, rather than what a whole branch wears. */
  readonly own: boolean;
  /** The slot that the rows above it wear, or `PASS` for what they would without it. */
  readonly bears: number | typeof PASS;
}

/** What a row bears goes on wearing what the row's parent bears. */
export const PASS = "pass";

export type Look = "plain" | "marked" | "hidden";

/** A rotation: x, y, z, w. */
export type Rotation = readonly [number, number, number, number];

/** Numbers a slot has: rotation; offset and look; own frame and radius; exponent and factor of the radius. */
const SLOT = 16;
const SLOTS_IN_LINE = 16;
const LINE = SLOTS_IN_LINE * SLOT;
/** Slots there are; the first stands for no guise. */
const MOST_SLOTS = 4096;
const LOOKS: Record<Look, number> = { plain: 0, marked: 1, hidden: 2 };

/** Writes the slots of one guise. */
export class SlotWriter {
  constructor(
    private readonly texels: Float32Array,
    private readonly first: number,
  ) {}

  /** A slot in which nothing is otherwise. */
  plain(slot: number): void {
    const at = (this.first + slot) * SLOT;
    this.texels.fill(0, at, at + SLOT);
    this.texels[at + 3] = 1;
    this.texels[at + 12] = 1;
    this.texels[at + 13] = 1;
  }

  /** Places go to rotation · (place − from) + to. */
  motion(slot: number, [x, y, z, w]: Rotation, from: Vec3, to: Vec3): void {
    const at = (this.first + slot) * SLOT;
    const turned = rotated([x, y, z, w], from);
    this.texels.set([x, y, z, w, to[0] - turned[0], to[1] - turned[1], to[2] - turned[2]], at);
  }

  look(slot: number, look: Look): void {
    this.texels[(this.first + slot) * SLOT + 7] = LOOKS[look];
  }

  /** The frame of a row's own, x y z w with w ≥ 0. */
  frame(slot: number, frames: Float32Array, row: number): void {
    this.texels.set(frames.subarray(4 * row, 4 * row + 3), (this.first + slot) * SLOT + 8);
  }

  /** The radius of a row's own. */
  radius(slot: number, radius: number): void {
    this.texels[(this.first + slot) * SLOT + 11] = radius;
  }

  /** Radii become factor · radius^exponent. */
  swelling(slot: number, exponent: number, factor: number): void {
    this.texels.set([exponent, factor], (this.first + slot) * SLOT + 12);
  }
}

/** The guises that are worn, and by which rows. Where two meet, the one put on later shows. */
export class Guises {
  /** For the shaders' `uGuises`. */
  readonly uniform: { value: DataTexture };
  private readonly worn = new Map<Guise, number>();
  private texels = new Float32Array(LINE);
  /** What each row wears: 0 for nothing, below 0 where it is its own. */
  private wears = new Int16Array(0);
  /** What the rows above each wear. */
  private bears = new Int16Array(0);
  private lowest = Number.POSITIVE_INFINITY;
  private known = 0;
  private stale = false;

  constructor() {
    this.uniform = { value: this.allocate() };
  }

  /** Whether any row may be elsewhere than the table has it. */
  get active(): boolean {
    return this.worn.size > 0;
  }

  has(guise: Guise): boolean {
    return this.worn.has(guise);
  }

  /** Puts a guise on; it shows with the next `dress`. False where there is no room for its slots. */
  put(guise: Guise): boolean {
    const taken = [...this.worn.keys()].reduce((sum, other) => sum + other.slots, 1);
    if (this.worn.has(guise) || taken + guise.slots > MOST_SLOTS) return false;
    this.worn.set(guise, taken);
    this.stale = true;
    return true;
  }

  /** Takes a guise off; says whether it was worn. */
  take(guise: Guise): boolean {
    if (!this.worn.delete(guise)) return false;
    this.stale = true;
    return true;
  }

  /** Takes off what the table has caught up with. */
  settle(table: TreeTable): void {
    for (const guise of [...this.worn.keys()]) if (guise.over(table)) this.take(guise);
  }

  /**
   * Has the rows wear what they should after the table or the guises changed, and tells of each that wears another
   * slot; false if nothing but what the slots say can have changed.
   */
  dress(
    table: TreeTable,
    changed: (row: number, slot: number, before: number) => void,
    tableChanged: boolean,
  ): boolean {
    if (!this.stale && !(tableChanged && this.active)) return false;
    this.stale = false;
    const { rows, parent } = table;
    let next = 1;
    const wearers = new Map<number, { wears: number; bears: number | null; end: number }>();
    let lowest = Number.POSITIVE_INFINITY;
    for (const guise of this.worn.keys()) {
      this.worn.set(guise, next);
      for (const { row, wears, own, bears } of guise.wearers(table)) {
        if (row >= rows) continue;
        const slot = (own ? -1 : 1) * (next + wears);
        wearers.set(row, { wears: slot, bears: bears === PASS ? null : next + bears, end: next + guise.slots });
        lowest = Math.min(lowest, row);
      }
      next += guise.slots;
    }
    this.wears = grown(this.wears, table.parent.length);
    this.bears = grown(this.bears, table.parent.length);
    // Rows that were cut off and came again have forgotten what they wore.
    this.wears.fill(0, Math.min(this.known, rows), rows);
    this.known = rows;
    const first = Math.min(lowest, this.lowest);
    for (let row = first; row < rows; row += 1) {
      const above = parent[row]!;
      const inherited = above >= first ? this.bears[above]! : 0;
      let wears = inherited;
      this.bears[row] = inherited;
      const wearer = wearers.size > 0 ? wearers.get(row) : undefined;
      if (wearer !== undefined && inherited < wearer.end) {
        wears = wearer.wears;
        this.bears[row] = wearer.bears ?? inherited;
      }
      const before = this.wears[row]!;
      if (wears === before) continue;
      this.wears[row] = wears;
      changed(row, wears, before);
    }
    this.lowest = lowest;
    this.write(table);
    return true;
  }

  /** Writes what the slots say, as the table is and the guises are now. */
  write(table: TreeTable): void {
    let end = 1;
    for (const [guise, first] of this.worn) end = Math.max(end, first + guise.slots);
    const lines = Math.ceil(end / SLOTS_IN_LINE);
    if (lines * LINE > this.texels.length) {
      let room = this.texels.length;
      while (room < lines * LINE) room *= 2;
      this.texels = grown(this.texels, room);
      this.uniform.value.dispose();
      this.uniform.value = this.allocate();
    }
    for (const [guise, first] of this.worn) guise.write(table, new SlotWriter(this.texels, first));
    this.uniform.value.needsUpdate = true;
  }

  /** Makes the next upload a whole one, as a restored context needs. */
  uploadWhole(): void {
    this.uniform.value.needsUpdate = true;
  }

  /** Where a row is drawn. */
  placeOf(table: TreeTable, row: number): Vec3 {
    const { position } = table;
    const place: Vec3 = [position[3 * row]!, position[3 * row + 1]!, position[3 * row + 2]!];
    const slot = this.slotOf(row);
    if (slot === 0) return place;
    const at = slot * SLOT;
    const t = this.texels;
    const [x, y, z] = rotated([t[at]!, t[at + 1]!, t[at + 2]!, t[at + 3]!], place);
    return [x + t[at + 4]!, y + t[at + 5]!, z + t[at + 6]!];
  }

  /** What a row wears: 0 for nothing, below 0 where it is its own. */
  wornBy(row: number): number {
    return this.active && row < this.known ? this.wears[row]! : 0;
  }

  /** What a radius becomes in a slot, as the slots were written last. */
  radiusIn(slot: number, radius: number): number {
    if (slot === 0) return radius;
    const at = Math.abs(slot) * SLOT;
    const own = this.texels[at + 11]!;
    if (slot < 0 && own > 0) return own;
    const [exponent, factor] = [this.texels[at + 12]!, this.texels[at + 13]!];
    return exponent === 1 ? radius : factor * Math.max(radius, 1e-4) ** exponent;
  }

  /** Whether a row is not drawn at all. */
  hides(row: number): boolean {
    const slot = this.slotOf(row);
    return slot !== 0 && this.texels[slot * SLOT + 7] === LOOKS.hidden;
  }

  dispose(): void {
    this.uniform.value.dispose();
  }

  private slotOf(row: number): number {
    return this.active && row < this.known ? Math.abs(this.wears[row]!) : 0;
  }

  private allocate(): DataTexture {
    const texture = new DataTexture(
      this.texels,
      (SLOTS_IN_LINE * SLOT) / 4,
      this.texels.length / LINE,
      RGBAFormat,
      FloatType,
    );
    texture.minFilter = NearestFilter;
    texture.magFilter = NearestFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
  }
}

/** A vector turned. */
export function rotated([x, y, z, w]: Rotation, [a, b, c]: Vec3): Vec3 {
  const ux = y * c - z * b + w * a;
  const uy = z * a - x * c + w * b;
  const uz = x * b - y * a + w * c;
  return [a + 2 * (y * uz - z * uy), b + 2 * (z * ux - x * uz), c + 2 * (x * uy - y * ux)];
}
