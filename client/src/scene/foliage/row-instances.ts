import type { ShaderMaterial } from "three";
import { BlockGeometry } from "../block-geometry";
import { LEAF_TEXELS } from "../glsl/leaf";
import { ItemTexture } from "../item-texture";
import type { Card } from "./leaf-cards";
import { LeafSlots } from "./leaf-slots";

/** Row, parent's row, azimuth and share of the way along; a random number with the vigor above the point, one of the shoot's, stance and length. */
const STRIDE = 4 * LEAF_TEXELS;
const TINT = 4;
const NOTHING = -1;

/** How something stands on its metamer. */
export interface Standing {
  readonly azimuth: number;
  /** The share of the way along. */
  readonly along: number;
  /** The code of its stance (LF5); below 0 where it stands by rule. */
  readonly stance: number;
  /** In internodes; 0 for what the look says. */
  readonly length: number;
}
/** Instances may be so many times those that show something, and a few more, before they are moved together. */
const MOST_ROOM = 1.25;
const SLACK = 256;

/** Things that rows bear, a few each, as cards; one geometry for each level of detail. */
export class RowInstances {
  readonly geometries: readonly BlockGeometry[];
  private readonly slots = new LeafSlots();
  private readonly items = new ItemTexture(Float32Array, LEAF_TEXELS);
  private step = 1;

  /** The materials draw these things and no others. */
  constructor(levels: readonly Card[], materials: readonly ShaderMaterial[]) {
    this.geometries = levels.map(() => new BlockGeometry());
    this.shape(levels);
    for (const material of materials) this.items.enter(material);
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
      this.geometries[i]!.shape("card", card.array, card.itemSize, index);
    }
    this.draw();
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
    this.items.reserve(this.slots.end);
    this.items.touch(first, count);
    return first;
  }

  /** Writes what a row bears in a slot: how it stands, the row's vigor, a random number and one of the shoot's. */
  write(
    slot: number,
    row: number,
    parent: number,
    { azimuth, along, stance, length }: Standing,
    vigor: number,
    random: number,
    shoot = random,
  ): void {
    const values = [row, parent, azimuth, along, vigor + Math.min(random, 0.999), shoot, stance, length];
    this.items.numbers.set(values, slot * STRIDE);
  }

  /** Uploads what was written since the last call. */
  upload(): void {
    if (this.slots.end > MOST_ROOM * this.slots.filled + SLACK) {
      this.slots.compact((to, from, count) => {
        this.items.numbers.copyWithin(to * STRIDE, from * STRIDE, (from + count) * STRIDE);
      });
      if (this.slots.end > 0) this.items.touch(0, this.slots.end);
    }
    this.items.upload(this.slots.end);
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
    for (const geometry of this.geometries) geometry.dispose();
  }

  private readonly clear = (first: number, count: number): void => {
    for (let slot = first; slot < first + count; slot += 1) this.items.numbers[slot * STRIDE + TINT] = NOTHING;
    this.items.touch(first, count);
  };

  private draw(): void {
    for (const geometry of this.geometries) geometry.draw(Math.ceil(this.items.count / this.step));
  }
}
