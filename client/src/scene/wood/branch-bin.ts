import type { RawShaderMaterial } from "three";
import type { BlockGeometry } from "../block-geometry";
import { METAMER_TEXELS } from "../glsl/branch";
import { ItemTexture } from "../item-texture";

/** Row, parent's row, row at which the axis begins, flags. */
const STRIDE = 4 * METAMER_TEXELS;
const FLAGS = 3;

/** Metamers drawn with the same shapes, in no order: a list that several geometries share. */
export class BranchBin {
  count = 0;
  private readonly items = new ItemTexture(Uint32Array, METAMER_TEXELS);
  private readonly materials: RawShaderMaterial[] = [];
  private step = 1;

  constructor(private readonly geometries: readonly BlockGeometry[]) {}

  /** Another material like this one, which draws these metamers and no others. */
  materialLike(material: RawShaderMaterial): RawShaderMaterial {
    const own = this.items.copyOf(material);
    this.materials.push(own);
    return own;
  }

  /** Row, parent's row, row at which the axis begins and flags in a slot. */
  read(slot: number): readonly [row: number, parent: number, origin: number, flags: number] {
    const at = slot * STRIDE;
    const { numbers } = this.items;
    return [numbers[at]!, numbers[at + 1]!, numbers[at + 2]!, numbers[at + 3]!];
  }

  flagsOf(slot: number): number {
    return this.items.numbers[slot * STRIDE + FLAGS]!;
  }

  setFlags(slot: number, flags: number): void {
    if (this.flagsOf(slot) === flags) return;
    this.items.numbers[slot * STRIDE + FLAGS] = flags;
    this.items.touch(slot);
  }

  /** Adds a metamer; returns its slot. */
  add(row: number, parent: number, origin: number, flags: number): number {
    const slot = this.count;
    this.count += 1;
    this.items.reserve(this.count);
    this.write(slot, row, parent, origin, flags);
    return slot;
  }

  /** Frees a slot for the last metamer; returns the row that has moved into it, or −1. */
  remove(slot: number): number {
    const last = this.count - 1;
    this.count = last;
    if (slot === last) return -1;
    const { numbers } = this.items;
    numbers.copyWithin(slot * STRIDE, last * STRIDE, (last + 1) * STRIDE);
    this.items.touch(slot);
    return numbers[slot * STRIDE]!;
  }

  /** Moves the metamer of a slot to the end of another list; returns the row that has moved into the slot, or −1. */
  moveTo(other: BranchBin, slot: number): number {
    const at = slot * STRIDE;
    const { numbers } = this.items;
    other.add(numbers[at]!, numbers[at + 1]!, numbers[at + 2]!, numbers[at + FLAGS]!);
    return this.remove(slot);
  }

  write(slot: number, row: number, parent: number, origin: number, flags: number): void {
    const at = slot * STRIDE;
    const { numbers } = this.items;
    const same =
      numbers[at] === row && numbers[at + 1] === parent && numbers[at + 2] === origin && numbers[at + 3] === flags;
    if (same) return;
    numbers[at] = row;
    numbers[at + 1] = parent;
    numbers[at + 2] = origin;
    numbers[at + 3] = flags;
    this.items.touch(slot);
  }

  upload(): void {
    this.items.upload(this.count);
    this.draw();
  }

  /** Draws only every so manieth. */
  thin(step: number): void {
    if (step === this.step) return;
    this.step = step;
    this.items.thin(step);
    this.draw();
  }

  /** A restored context has lost the texture. */
  restored(): void {
    this.items.uploadWhole();
  }

  dispose(): void {
    this.items.dispose();
    for (const part of [...this.geometries, ...this.materials]) part.dispose();
  }

  private draw(): void {
    for (const geometry of this.geometries) geometry.draw(Math.ceil(this.items.count / this.step));
  }
}
