import type { Mesh } from "three";
import { DEFAULT_APPEARANCE, type FlowerLook, type FruitLook, type LeafLook } from "../../wire/generated";
import type { Box } from "../camera/camera-view";
import type { Materials, Uniforms } from "../materials";
import type { GradualTextures } from "../painting/gradual-textures";
import type { Sort } from "../painting/paint";
import type { Painter } from "../painting/painter";
import type { Fineness } from "../rendering/fineness";
import { Dirty, type TreeTable } from "../table/tree-table";
import { LeafRows } from "./leaf-rows";
import { LeafUniforms } from "./leaf-uniforms";
import { FLOWERS, FRUITS } from "./ornament-sorts";
import { Ornaments } from "./ornaments";
import { Sprigs } from "./sprigs";

/** Leaves, flowers and fruits. */
export class Foliage {
  /** Drawn into the picture. */
  readonly meshes: readonly Mesh[];
  /** Drawn into the shadow map. */
  readonly casters: readonly Mesh[];
  readonly textures: readonly GradualTextures<Sort>[];
  private readonly uniforms: LeafUniforms;
  private readonly leaves: LeafRows;
  private readonly sprigs: Sprigs;
  private readonly flowers: Ornaments<FlowerLook>;
  private readonly fruits: Ornaments<FruitLook>;

  constructor(materials: Materials, uniforms: Uniforms, painter: Painter) {
    this.uniforms = new LeafUniforms(uniforms, painter);
    this.leaves = new LeafRows(materials, uniforms);
    this.sprigs = new Sprigs(materials, uniforms);
    this.flowers = new Ornaments(FLOWERS, materials.flower, materials.flowerDepth, uniforms, painter);
    this.fruits = new Ornaments(FRUITS, materials.fruit, materials.fruitDepth, uniforms, painter);
    this.textures = [this.uniforms.textures, this.flowers.textures, this.fruits.textures];
    const parts = [this.leaves, this.sprigs, this.flowers, this.fruits];
    this.meshes = parts.map(({ mesh }) => mesh);
    this.casters = parts.map(({ caster }) => caster);
    const { leaves, flowers, fruits } = DEFAULT_APPEARANCE;
    this.setLook(leaves, flowers, fruits);
  }

  /** Changes what all of them look like; flowers and fruits may then be elsewhere. */
  setLook(leaves: LeafLook, flowers: FlowerLook, fruits: FruitLook): void {
    this.uniforms.setLook(leaves);
    this.flowers.setLook(flowers);
    this.fruits.setLook(fruits);
  }

  /** Removes everything on rows from `rows` on. */
  truncate(rows: number): void {
    this.leaves.truncate(rows);
    this.sprigs.truncate(rows);
    this.flowers.truncate(rows);
    this.fruits.truncate(rows);
  }

  /** A row has changed in the way its `Dirty` bits say. */
  update(table: TreeTable, row: number, bits: number): void {
    if ((bits & Dirty.Shape) !== 0) {
      this.leaves.update(table, row);
      this.sprigs.update(table, row);
    }
    this.flowers.update(table, row, bits);
    this.fruits.update(table, row, bits);
  }

  /** Chooses how finely everything in the box is drawn. */
  detail(fineness: Fineness, box: Box): void {
    this.leaves.detail(fineness, box);
    this.sprigs.detail(fineness, box, this.leaves);
    this.flowers.detail(fineness);
    this.fruits.detail(fineness);
  }

  /** The meshes that nearly every tree uses. */
  get essential(): readonly Mesh[] {
    return [this.leaves, this.sprigs].flatMap(({ mesh, caster }) => [mesh, caster]);
  }

  /** How far leaves have given way to sprigs, 0 to 1; shadows are those of what is drawn. */
  get merged(): number {
    return this.sprigs.share;
  }

  /** Uploads what was written since the last call. */
  upload(table: TreeTable): void {
    this.leaves.upload();
    this.sprigs.upload();
    this.flowers.upload(table);
    this.fruits.upload(table);
  }

  /** A restored context has lost every texture. */
  restored(): void {
    this.uniforms.restored();
    this.leaves.restored();
    this.sprigs.restored();
    this.flowers.restored();
    this.fruits.restored();
  }

  dispose(): void {
    for (const part of [this.uniforms, this.leaves, this.sprigs, this.flowers, this.fruits]) part.dispose();
  }
}
