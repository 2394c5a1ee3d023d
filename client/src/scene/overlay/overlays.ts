import { DataTexture, FloatType, NearestFilter, RGBAFormat } from "three";
import { grown } from "../table/column";
import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";

/**
 * Draws some rows differently from the table: a bend, a cut or a width that the server has not confirmed yet. It is
 * removed when the table has caught up, or when the user gives up.
 */
export interface Overlay {
  /** The number of slots it needs; a slot describes how a set of rows is drawn. */
  readonly slots: number;
  /** The rows from which its slots apply. */
  assignments(table: TreeTable): Iterable<SlotAssignment>;
  /** Writes the content of its slots for the present table. */
  write(table: TreeTable, out: SlotWriter): void;
  /** Whether it has no purpose any more: the table has caught up, or the rows are gone. */
  over(table: TreeTable): boolean;
}

/** Assigns slots to a row and to the rows above it; slots count from 0 within the overlay. */
export interface SlotAssignment {
  readonly row: number;
  /** The slot of the row itself. */
  readonly slot: number;
  /** Whether that slot holds an orientation and a radius for this row alone. */
  readonly own: boolean;
  /** The slot of the rows above it; `INHERIT`: the slot they have without this assignment. */
  readonly above: number | typeof INHERIT;
}

/** The rows above a row keep the slot that applies above its parent. */
export const INHERIT = "inherit";

export type Look = "plain" | "marked" | "hidden";

/** A rotation: x, y, z, w. */
export type Rotation = readonly [number, number, number, number];

/** The numbers of a slot: rotation; offset and look; own orientation and radius; exponent and factor of the radius. */
const SLOT = 16;
const SLOTS_IN_LINE = 16;
const LINE = SLOTS_IN_LINE * SLOT;
/** The number of slots; the first means "no overlay". */
const MOST_SLOTS = 4096;
const LOOKS: Record<Look, number> = { plain: 0, marked: 1, hidden: 2 };

/** Writes the slots of one overlay. */
export class SlotWriter {
  constructor(
    private readonly texels: Float32Array,
    private readonly first: number,
  ) {}

  /** Makes a slot neutral: rows are drawn as the table has them. */
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

  /** The orientation of one row, x y z w with w ≥ 0. */
  orientation(slot: number, orientations: Float32Array, row: number): void {
    this.texels.set(orientations.subarray(4 * row, 4 * row + 3), (this.first + slot) * SLOT + 8);
  }

  /** The radius of one row. */
  radius(slot: number, radius: number): void {
    this.texels[(this.first + slot) * SLOT + 11] = radius;
  }

  /** Radii become factor · radius^exponent. */
  swelling(slot: number, exponent: number, factor: number): void {
    this.texels.set([exponent, factor], (this.first + slot) * SLOT + 12);
  }
}

/** The overlays that are shown, and the slot of each row. Where two apply to a row, the later one wins. */
export class Overlays {
  /** For the shaders' `uOverlays`. */
  readonly uniform: { value: DataTexture };
  /** Each overlay with its first slot. */
  private readonly shown = new Map<Overlay, number>();
  private texels = new Float32Array(LINE);
  /** The slot of each row: 0 for none, below 0 where the slot holds its own orientation and radius. */
  private slots = new Int16Array(0);
  /** The slot that applies above each row. */
  private above = new Int16Array(0);
  private lowest = Number.POSITIVE_INFINITY;
  private known = 0;
  private stale = false;

  constructor() {
    this.uniform = { value: this.allocate() };
  }

  /** Whether any row may be elsewhere than the table has it. */
  get active(): boolean {
    return this.shown.size > 0;
  }

  has(overlay: Overlay): boolean {
    return this.shown.has(overlay);
  }

  /** Adds an overlay, which shows after the next `assign`. False if there are not enough slots left. */
  add(overlay: Overlay): boolean {
    const taken = [...this.shown.keys()].reduce((sum, other) => sum + other.slots, 1);
    if (this.shown.has(overlay) || taken + overlay.slots > MOST_SLOTS) return false;
    this.shown.set(overlay, taken);
    this.stale = true;
    return true;
  }

  /** Removes an overlay; false if it was not shown. */
  remove(overlay: Overlay): boolean {
    if (!this.shown.delete(overlay)) return false;
    this.stale = true;
    return true;
  }

  /** Removes the overlays that have no purpose any more. */
  settle(table: TreeTable): void {
    for (const overlay of [...this.shown.keys()]) if (overlay.over(table)) this.remove(overlay);
  }

  /**
   * Assigns slots to rows after the table or the overlays have changed, and calls `changed` for each row that gets
   * another slot. False if no assignment can have changed, only the content of the slots.
   */
  assign(
    table: TreeTable,
    changed: (row: number, slot: number, before: number) => void,
    tableChanged: boolean,
  ): boolean {
    if (!this.stale && !(tableChanged && this.active)) return false;
    this.stale = false;
    const { rows, parent } = table;
    let next = 1;
    const assigned = new Map<number, { slot: number; above: number | null; end: number }>();
    let lowest = Number.POSITIVE_INFINITY;
    for (const overlay of this.shown.keys()) {
      this.shown.set(overlay, next);
      for (const { row, slot, own, above } of overlay.assignments(table)) {
        if (row >= rows) continue;
        const signed = (own ? -1 : 1) * (next + slot);
        assigned.set(row, { slot: signed, above: above === INHERIT ? null : next + above, end: next + overlay.slots });
        lowest = Math.min(lowest, row);
      }
      next += overlay.slots;
    }
    this.slots = grown(this.slots, table.parent.length);
    this.above = grown(this.above, table.parent.length);
    // Rows that were truncated and appended again have no slot.
    this.slots.fill(0, Math.min(this.known, rows), rows);
    this.known = rows;
    const first = Math.min(lowest, this.lowest);
    for (let row = first; row < rows; row += 1) {
      const below = parent[row]!;
      const inherited = below >= first ? this.above[below]! : 0;
      let slot = inherited;
      this.above[row] = inherited;
      const assignment = assigned.size > 0 ? assigned.get(row) : undefined;
      if (assignment !== undefined && inherited < assignment.end) {
        slot = assignment.slot;
        this.above[row] = assignment.above ?? inherited;
      }
      const before = this.slots[row]!;
      if (slot === before) continue;
      this.slots[row] = slot;
      changed(row, slot, before);
    }
    this.lowest = lowest;
    this.write(table);
    return true;
  }

  /** Writes the content of all slots for the present table and overlays. */
  write(table: TreeTable): void {
    let end = 1;
    for (const [overlay, first] of this.shown) end = Math.max(end, first + overlay.slots);
    const lines = Math.ceil(end / SLOTS_IN_LINE);
    if (lines * LINE > this.texels.length) {
      let capacity = this.texels.length;
      while (capacity < lines * LINE) capacity *= 2;
      this.texels = grown(this.texels, capacity);
      this.uniform.value.dispose();
      this.uniform.value = this.allocate();
    }
    for (const [overlay, first] of this.shown) overlay.write(table, new SlotWriter(this.texels, first));
    this.uniform.value.needsUpdate = true;
  }

  /** Makes the next upload a whole one, as a restored context needs. */
  uploadWhole(): void {
    this.uniform.value.needsUpdate = true;
  }

  /** Where a row is drawn. */
  placeOf(table: TreeTable, row: number): Vec3 {
    const { placed } = table.course;
    const place: Vec3 = [placed[3 * row]!, placed[3 * row + 1]!, placed[3 * row + 2]!];
    const slot = Math.abs(this.slotOf(row));
    if (slot === 0) return place;
    const at = slot * SLOT;
    const t = this.texels;
    const [x, y, z] = rotated([t[at]!, t[at + 1]!, t[at + 2]!, t[at + 3]!], place);
    return [x + t[at + 4]!, y + t[at + 5]!, z + t[at + 6]!];
  }

  /** The slot of a row: 0 for none, below 0 where the slot holds its own orientation and radius. */
  slotOf(row: number): number {
    return this.active && row < this.known ? this.slots[row]! : 0;
  }

  /** The radius that a slot makes of a radius, as the slots were written last. */
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
    const slot = Math.abs(this.slotOf(row));
    return slot !== 0 && this.texels[slot * SLOT + 7] === LOOKS.hidden;
  }

  dispose(): void {
    this.uniform.value.dispose();
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
