import { DynamicDrawUsage, InstancedBufferAttribute, type InstancedBufferGeometry } from "three";
import { grown } from "../table/column";
import { uploadRange } from "../upload-range";

/** Row, parent's row, row at which the axis begins, flags. */
const STRIDE = 4;
const FLAGS = 3;

/** Metamers drawn with the same shapes, in no order: a list of instances that several geometries share. */
export class BranchBin {
  count = 0;
  private instances = new Uint32Array(256 * STRIDE);
  private attribute = this.allocate();
  private changedFrom = Number.POSITIVE_INFINITY;
  private changedTo = 0;

  constructor(private readonly geometries: readonly InstancedBufferGeometry[]) {
    this.bind();
  }

  /** Row, parent's row, row at which the axis begins and flags in a slot. */
  read(slot: number): readonly [row: number, parent: number, origin: number, flags: number] {
    const at = slot * STRIDE;
    const { instances } = this;
    return [instances[at]!, instances[at + 1]!, instances[at + 2]!, instances[at + 3]!];
  }

  flagsOf(slot: number): number {
    return this.instances[slot * STRIDE + FLAGS]!;
  }

  setFlags(slot: number, flags: number): void {
    if (this.flagsOf(slot) === flags) return;
    this.instances[slot * STRIDE + FLAGS] = flags;
    this.touch(slot);
  }

  /** Adds a metamer; returns its slot. */
  add(row: number, parent: number, origin: number, flags: number): number {
    const slot = this.count;
    this.count += 1;
    if (this.count * STRIDE > this.instances.length) this.grow();
    this.write(slot, row, parent, origin, flags);
    return slot;
  }

  /** Frees a slot for the last metamer; returns the row that has moved into it, or −1. */
  remove(slot: number): number {
    const last = this.count - 1;
    this.count = last;
    if (slot === last) return -1;
    this.instances.copyWithin(slot * STRIDE, last * STRIDE, (last + 1) * STRIDE);
    this.touch(slot);
    return this.instances[slot * STRIDE]!;
  }

  /** Moves the metamer of a slot to the end of another list; returns the row that has moved into the slot, or −1. */
  moveTo(other: BranchBin, slot: number): number {
    const at = slot * STRIDE;
    const { instances } = this;
    other.add(instances[at]!, instances[at + 1]!, instances[at + 2]!, instances[at + FLAGS]!);
    return this.remove(slot);
  }

  write(slot: number, row: number, parent: number, origin: number, flags: number): void {
    const at = slot * STRIDE;
    const { instances } = this;
    const same =
      instances[at] === row &&
      instances[at + 1] === parent &&
      instances[at + 2] === origin &&
      instances[at + 3] === flags;
    if (same) return;
    instances[at] = row;
    instances[at + 1] = parent;
    instances[at + 2] = origin;
    instances[at + 3] = flags;
    this.touch(slot);
  }

  upload(): void {
    for (const geometry of this.geometries) geometry.instanceCount = this.count;
    if (this.changedTo === 0) return;
    uploadRange(this.attribute, this.changedFrom * STRIDE, (this.changedTo - this.changedFrom) * STRIDE);
    this.changedFrom = Number.POSITIVE_INFINITY;
    this.changedTo = 0;
  }

  dispose(): void {
    for (const geometry of this.geometries) geometry.dispose();
  }

  private grow(): void {
    this.instances = grown(this.instances, 2 * this.instances.length);
    // A buffer cannot grow on the GPU; geometries that held the old one let go of it.
    this.dispose();
    this.attribute = this.allocate();
    this.bind();
  }

  private bind(): void {
    for (const geometry of this.geometries) geometry.setAttribute("metamer", this.attribute);
  }

  private touch(slot: number): void {
    this.changedFrom = Math.min(this.changedFrom, slot);
    this.changedTo = Math.max(this.changedTo, slot + 1);
  }

  private allocate(): InstancedBufferAttribute {
    const attribute = new InstancedBufferAttribute(this.instances, STRIDE);
    attribute.setUsage(DynamicDrawUsage);
    return attribute;
  }
}
