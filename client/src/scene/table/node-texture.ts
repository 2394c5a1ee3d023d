import { DataTexture, FloatType, NearestFilter, RGBAFormat } from "three";
import { CHUNK_ROWS } from "../../wire/generated";
import { grown } from "./column";
import type { PlaceEase } from "./place-ease";
import { EASE_SECONDS, eased } from "./radius-ease";
import { DYES, type RowDyes } from "./row-dyes";
import type { TreeTable } from "./tree-table";

/**
 * Texels each row has: position and radius; orientation, and light with slot and dye; birth, duration, extension and arc,
 * of a seed the number of its tree. A duration below 0 says that its radius glides: from minus this, since the birth
 * beside it.
 */
const TEXELS = 3;
const LINE = CHUNK_ROWS * TEXELS * 4;
const NEVER = 1e9;
/** How long a tip goes on growing after its metamer is as long as it will be, in seconds. */
const AFTERGROWTH = 0.3;
/** Light is a share of this below one, so that it leaves the whole numbers to slot and dye. */
const LIGHT_STEPS = 256;

/** The node table on the GPU: one line of the texture is one chunk, so that a delta uploads only its chunks. */
export class NodeTexture {
  /** For the shaders' `uNodes`; the texture is another one when the table outgrows it. */
  readonly uniform: { value: DataTexture };
  private texels = new Float32Array(4 * LINE);
  /** The overlay slot of each row, see `overlays.ts`. */
  private slots = new Int16Array(0);
  private readonly stale = new Set<number>();
  /** Whether the graphics card has yet to get all of it: parts of a new texture would leave the others empty. */
  private whole = true;

  /** With the dye of each row; without, none has any. */
  constructor(private readonly dyes: Pick<RowDyes, "of"> = { of: () => 0 }) {
    this.uniform = { value: this.allocate() };
  }

  /** Reserves capacity for `rows`. */
  reserve(rows: number): void {
    const lines = Math.ceil(rows / CHUNK_ROWS);
    this.slots = grown(this.slots, lines * CHUNK_ROWS);
    let height = this.texels.length / LINE;
    if (lines <= height) return;
    while (height < lines) height *= 2;
    this.texels = grown(this.texels, height * LINE);
    this.uniform.value.dispose();
    this.uniform.value = this.allocate();
    this.uploadWhole();
  }

  /** Makes the next upload a whole one, as a new texture or a restored context needs. */
  uploadWhole(): void {
    this.whole = true;
    this.uniform.value.clearUpdateRanges();
    this.uniform.value.needsUpdate = true;
  }

  /** Copies a row from the table. */
  write(table: TreeTable, row: number): void {
    const { texels } = this;
    const at = 4 * TEXELS * row;
    const onward = table.limbs.onward[row]!;
    const { placed, arc } = table.course;
    texels[at] = placed[3 * row]!;
    texels[at + 1] = placed[3 * row + 1]!;
    texels[at + 2] = placed[3 * row + 2]!;
    texels[at + 3] = table.girth.radius[row]!;
    const parent = table.parent[row]!;
    // A seed is drawn as thick as its trunk, which spreads at its foot by that measure all the way up.
    if (parent >= 0 && table.parent[parent]! < 0 && table.successor[parent] === row) {
      texels[4 * TEXELS * parent + 3] = texels[at + 3]!;
      this.stale.add(Math.floor(parent / CHUNK_ROWS));
    }
    texels[at + 4] = table.orientations[4 * row]!;
    texels[at + 5] = table.orientations[4 * row + 1]!;
    texels[at + 6] = table.orientations[4 * row + 2]!;
    texels[at + 7] = this.packed(table, row);
    texels[at + 8] = table.birth[row]!;
    texels[at + 9] = table.growing[row]!;
    texels[at + 10] = onward < 0 ? NEVER : table.birth[onward]!;
    texels[at + 11] = parent < 0 ? table.numberOf(row) : arc[row]!;
    this.stale.add(Math.floor(row / CHUNK_ROWS));
  }

  /** Whether anything has been shown of a row. */
  shows(row: number): boolean {
    return (this.texels[4 * TEXELS * row + 3] ?? 0) > 0;
  }

  /**
   * The radius a row is shown with, given what the overlay makes of a radius in the table; 0 where nothing is shown, or where the
   * row is still growing out and its radius with it.
   */
  shownRadius(row: number, now: number, overlaid: (radius: number) => number): number {
    const { texels } = this;
    const at = 4 * TEXELS * row;
    const radius = texels[at + 3] ?? 0;
    if (radius <= 0) return 0;
    const [birth, growing] = [texels[at + 8]!, texels[at + 9]!];
    if (growing >= 0) return birth + growing + AFTERGROWTH <= now ? overlaid(radius) : 0;
    return -growing + (overlaid(radius) + growing) * eased(now - birth, EASE_SECONDS);
  }

  /** Has the radius of a row, which is in place, glide from another one to its own. */
  ease(row: number, from: number, now: number): void {
    const at = 4 * TEXELS * row;
    this.texels[at + 8] = now;
    this.texels[at + 9] = -from;
    this.stale.add(Math.floor(row / CHUNK_ROWS));
  }

  /** Notes where a row is shown, which is about to be written anew. */
  notePlace(places: PlaceEase, row: number): void {
    if (this.shows(row)) places.note(row, this.texels, 4 * TEXELS * row);
  }

  /** Shows a row on its way from a place to its own, of which so much is left. */
  glide(table: TreeTable, row: number, from: Float32Array, at: number, left: number): void {
    const { placed } = table.course;
    const to = 4 * TEXELS * row;
    for (let axis = 0; axis < 3; axis += 1) {
      const own = placed[3 * row + axis]!;
      this.texels[to + axis] = own + left * (from[at + axis]! - own);
    }
    this.stale.add(Math.floor(row / CHUNK_ROWS));
  }

  /** Rows from `rows` on are gone. */
  truncate(rows: number): void {
    this.texels.fill(0, 4 * TEXELS * rows);
  }

  /** Gives a row another overlay slot: 0 for none, below 0 for one of its own. */
  setSlot(table: TreeTable, row: number, slot: number): void {
    this.slots[row] = slot;
    this.texels[4 * TEXELS * row + 7] = this.packed(table, row);
    this.stale.add(Math.floor(row / CHUNK_ROWS));
  }

  /** A row has another dye. */
  dyed(table: TreeTable, row: number): void {
    this.texels[4 * TEXELS * row + 7] = this.packed(table, row);
    this.stale.add(Math.floor(row / CHUNK_ROWS));
  }

  /** Has three.js upload the lines written since the last call. */
  upload(): void {
    if (this.stale.size === 0) return;
    const texture = this.uniform.value;
    if (!this.whole) {
      for (const line of this.stale) texture.addUpdateRange(line * LINE, LINE);
    }
    texture.needsUpdate = true;
    this.stale.clear();
  }

  dispose(): void {
    this.uniform.value.dispose();
  }

  /** Slot, dye and light in one number, of whose 24 bits they take 12, 4 and 8; the shaders separate them. */
  private packed(table: TreeTable, row: number): number {
    const slot = this.slots[row]!;
    const value = Math.abs(slot) * DYES + this.dyes.of(row) + table.light[row]! / LIGHT_STEPS;
    return slot < 0 ? -value : value;
  }

  private allocate(): DataTexture {
    const texture = new DataTexture(this.texels, CHUNK_ROWS * TEXELS, this.texels.length / LINE, RGBAFormat, FloatType);
    texture.minFilter = NearestFilter;
    texture.magFilter = NearestFilter;
    texture.generateMipmaps = false;
    texture.onUpdate = () => {
      this.whole = false;
    };
    texture.needsUpdate = true;
    return texture;
  }
}
