import { Mesh, type RawShaderMaterial, Vector3 } from "three";
import { BlockGeometry } from "../block-geometry";
import { METAMER_TEXELS } from "../glsl/branch";
import { ItemTexture } from "../item-texture";
import type { Materials } from "../materials";
import type { TreeTable } from "../table/tree-table";

const STRIDE = 4 * METAMER_TEXELS;
/** What lines are drawn in: on paper, and over the tree. */
const INK = [0.16, 0.13, 0.11] as const;
const CHALK = [1, 0.86, 0.45] as const;

/** The axes as thin lines, one strip a metamer; rebuilt when the tree changes, and only while this mode is shown. */
export class SkeletonLines {
  readonly mesh: Mesh;
  private readonly items = new ItemTexture(Uint32Array, METAMER_TEXELS);
  private readonly geometry = new BlockGeometry().shape("strip", [-1, 0, 1, 0, -1, 1, 1, 1], 2, [0, 1, 2, 2, 1, 3]);
  private readonly ink = new Vector3().fromArray(INK);
  private readonly material: RawShaderMaterial;
  private stale = true;

  constructor(materials: Pick<Materials, "skeleton">) {
    this.material = materials.skeleton;
    this.material.uniforms.uInk = { value: this.ink };
    this.mesh = new Mesh(this.geometry, this.items.enter(materials.skeleton));
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /** The table has changed. */
  changed(): void {
    this.stale = true;
  }

  /** Draws them over the tree, whatever stands before them, or alone. */
  over(tree: boolean): void {
    this.ink.fromArray(tree ? CHALK : INK);
    this.material.depthTest = !tree;
  }

  /** Shows the axes of the table, or nothing; of more metamers than `most` only every so manieth. */
  show(table: TreeTable, shown: boolean, most = Number.POSITIVE_INFINITY): void {
    this.mesh.visible = shown && table.rows > 0;
    if (!this.mesh.visible || !this.stale) return;
    this.stale = false;
    this.items.reserve(table.rows);
    const { numbers } = this.items;
    let count = 0;
    for (let row = 0; row < table.rows; row += 1) {
      const parent = table.parent[row]!;
      if (parent < 0 || table.radiusCode[row] === 0) continue;
      numbers[STRIDE * count] = row;
      numbers[STRIDE * count + 1] = parent;
      count += 1;
    }
    this.items.touch(0, Math.max(1, count));
    this.items.upload(count);
    const step = Math.max(1, Math.ceil(count / most));
    this.items.thin(step);
    this.geometry.draw(Math.ceil(count / step));
  }

  /** A restored context has lost the texture. */
  restored(): void {
    this.items.uploadWhole();
  }

  dispose(): void {
    this.items.dispose();
    this.geometry.dispose();
  }
}
