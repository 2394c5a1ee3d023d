import { DataTexture, FloatType, NearestFilter, RedFormat, Vector2, Vector3 } from "three";
import { CHUNK_ROWS } from "../../wire/generated";
import type { Uniforms } from "../materials";
import { AxisOrders } from "../table/axis-orders";
import type { TreeTable } from "../table/tree-table";
import { DRAW_MODES, type DrawMode, type Extremes, type Legend, legendOf, TRAITS } from "./draw-mode";
import { RAMP_COLOURS } from "./ramps";

/** The number that the present draw mode shows of each row, one line of texels a chunk; empty while none does. */
export class TraitTexture {
  private readonly orders = new AxisOrders();
  private readonly mode = { value: 0 };
  private readonly ends = { value: new Vector2(0, 1) };
  private readonly ramp = { value: Array.from({ length: RAMP_COLOURS }, () => new Vector3()) };
  private readonly texture: { value: DataTexture };
  private texels = new Float32Array(CHUNK_ROWS);
  private extremes: Extremes = { least: 0, most: 0 };
  private firstStale = 0;
  private drawMode: DrawMode = "lit";

  constructor(uniforms: Uniforms) {
    this.texture = { value: this.allocate() };
    Object.assign(uniforms, { uMode: this.mode, uTraitEnds: this.ends, uRamp: this.ramp, uTraits: this.texture });
  }

  /** Shows the number that a mode is for. */
  show(mode: DrawMode): void {
    this.drawMode = mode;
    this.mode.value = DRAW_MODES.indexOf(mode);
    this.firstStale = 0;
    for (const [i, colour] of (TRAITS[mode]?.ramp ?? []).entries()) this.ramp.value[i]!.set(...colour);
  }

  /** What the colours mean. */
  get legend(): Legend | null {
    return legendOf(this.drawMode, this.extremes);
  }

  /** Rows from `rows` on are gone. */
  truncate(rows: number): void {
    this.orders.forget(rows);
    this.firstStale = Math.min(this.firstStale, rows);
  }

  /** A row has changed; `moved` if its axis order may be another one. */
  update(row: number, moved: boolean): void {
    if (moved) this.orders.forget(row);
    this.firstStale = Math.min(this.firstStale, row);
  }

  /** Brings what is shown up to date with the table. */
  upload(table: TreeTable): void {
    const trait = TRAITS[this.drawMode];
    if (!trait || (this.firstStale >= table.rows && table.rows > 0)) return;
    this.orders.update(table);
    this.reserve(table.rows);
    const { values: orders } = this.orders;
    const { texels } = this;
    for (let row = this.firstStale; row < table.rows; row += 1) texels[row] = trait.of(table, row, orders);
    this.extremes = extremesOf(table, texels);
    this.ends.value.set(...trait.ends(this.extremes));
    // The whole texture: three.js can upload parts only of those with four numbers a texel.
    this.texture.value.needsUpdate = true;
    this.firstStale = Number.POSITIVE_INFINITY;
  }

  /** A restored context has lost the texture. */
  restored(): void {
    this.texture.value.needsUpdate = true;
  }

  dispose(): void {
    this.texture.value.dispose();
  }

  private reserve(rows: number): void {
    if (rows <= this.texels.length) return;
    let capacity = this.texels.length;
    while (capacity < rows) capacity *= 2;
    this.texels = new Float32Array(capacity);
    this.firstStale = 0;
    this.texture.value.dispose();
    this.texture.value = this.allocate();
  }

  private allocate(): DataTexture {
    const texture = new DataTexture(this.texels, CHUNK_ROWS, this.texels.length / CHUNK_ROWS, RedFormat, FloatType);
    texture.minFilter = NearestFilter;
    texture.magFilter = NearestFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
  }
}

/** Of the rows that are drawn. */
function extremesOf({ rows, radiusCode }: TreeTable, values: Float32Array): Extremes {
  let [least, most] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (let row = 0; row < rows; row += 1) {
    if (radiusCode[row] === 0) continue;
    const value = values[row]!;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return least <= most ? { least, most } : { least: 0, most: 0 };
}
