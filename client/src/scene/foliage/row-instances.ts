import {
  DynamicDrawUsage,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
} from "three";
import { grown } from "../table/column";
import { uploadRange } from "../upload-range";
import type { Card } from "./leaf-cards";
import { LeafSlots } from "./leaf-slots";

/** Row, parent's row, azimuth and share of the way along; a random number with the vigor above the point. */
const STRIDE = 5;
const TINT = 4;
const NOTHING = -1;
/** Instances may be so many times those that show something, and a few more, before they are moved together. */
const MOST_ROOM = 1.25;
const SLACK = 256;

/** Things that rows bear, a few each, as instances of a card; one geometry for each level of detail. */
export class RowInstances {
  readonly geometries: readonly InstancedBufferGeometry[];
  private readonly slots = new LeafSlots();
  private instances = new Float32Array(256 * STRIDE);
  private buffer = this.allocate();
  private changedFrom = Number.POSITIVE_INFINITY;
  private changedTo = 0;

  constructor(levels: readonly Card[]) {
    this.geometries = levels.map(() => new InstancedBufferGeometry());
    this.shape(levels);
    this.bind();
  }

  /** Instances that are drawn, those included that show nothing. */
  get count(): number {
    return this.slots.end;
  }

  /** Those that show something. */
  get filled(): number {
    return this.slots.filled;
  }

  /** Gives every instance another card. */
  shape(levels: readonly Card[]): void {
    for (const [i, { card, index }] of levels.entries()) {
      const geometry = this.geometries[i]!;
      geometry.dispose();
      geometry.setAttribute("card", card);
      geometry.setIndex(index);
    }
  }

  /** Rows from `rows` on bear nothing. */
  truncate(rows: number): void {
    this.slots.truncate(rows, this.clear);
  }

  countOf(row: number): number {
    return this.slots.countOf(row);
  }

  /** Has a row bear `count` things, and gives back the slot of the first; each is then to be written. */
  place(row: number, count: number): number {
    this.slots.assign(row, count, this.clear);
    if (count === 0) return NOTHING;
    const first = this.slots.firstOf(row);
    this.reserve(this.slots.end);
    this.touch(first, count);
    return first;
  }

  /** Writes what a row bears in a slot: its azimuth, its share of the way along, the row's vigor and a random number. */
  write(
    slot: number,
    row: number,
    parent: number,
    azimuth: number,
    along: number,
    vigor: number,
    random: number,
  ): void {
    const { instances } = this;
    const to = slot * STRIDE;
    instances[to] = row;
    instances[to + 1] = parent;
    instances[to + 2] = azimuth;
    instances[to + 3] = along;
    instances[to + TINT] = vigor + Math.min(random, 0.999);
  }

  /** Uploads what was written since the last call. */
  upload(): void {
    if (this.slots.end > MOST_ROOM * this.slots.filled + SLACK) {
      this.slots.compact((to, from, count) => {
        this.instances.copyWithin(to * STRIDE, from * STRIDE, (from + count) * STRIDE);
      });
      if (this.slots.end > 0) this.touch(0, this.slots.end);
    }
    for (const geometry of this.geometries) geometry.instanceCount = this.slots.end;
    if (this.changedTo === 0) return;
    uploadRange(this.buffer, this.changedFrom * STRIDE, (this.changedTo - this.changedFrom) * STRIDE);
    this.changedFrom = Number.POSITIVE_INFINITY;
    this.changedTo = 0;
  }

  dispose(): void {
    for (const geometry of this.geometries) geometry.dispose();
  }

  private readonly clear = (first: number, count: number): void => {
    for (let slot = first; slot < first + count; slot += 1) this.instances[slot * STRIDE + TINT] = NOTHING;
    this.touch(first, count);
  };

  private touch(first: number, count: number): void {
    this.changedFrom = Math.min(this.changedFrom, first);
    this.changedTo = Math.max(this.changedTo, first + count);
  }

  private reserve(slots: number): void {
    if (slots * STRIDE <= this.instances.length) return;
    let room = this.instances.length / STRIDE;
    while (room < slots) room *= 2;
    this.instances = grown(this.instances, room * STRIDE);
    // A buffer cannot grow on the GPU; geometries that held the old one let go of it.
    for (const geometry of this.geometries) geometry.dispose();
    this.buffer = this.allocate();
    this.bind();
  }

  private allocate(): InstancedInterleavedBuffer {
    const buffer = new InstancedInterleavedBuffer(this.instances, STRIDE);
    buffer.setUsage(DynamicDrawUsage);
    return buffer;
  }

  private bind(): void {
    for (const geometry of this.geometries) {
      geometry.setAttribute("leaf", new InterleavedBufferAttribute(this.buffer, 4, 0));
      geometry.setAttribute("tint", new InterleavedBufferAttribute(this.buffer, 1, TINT));
    }
  }
}
