import { BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, Mesh } from "three";
import type { Materials } from "../materials";
import type { TreeTable } from "../table/tree-table";

const STRIDE = 2;

/** The axes as thin lines, one strip a metamer; rebuilt when the tree changes, and only while this mode is shown. */
export class SkeletonLines {
  readonly mesh: Mesh;
  private geometry = strips(new Uint32Array(0));
  private stale = true;

  constructor(materials: Pick<Materials, "skeleton">) {
    this.mesh = new Mesh(this.geometry, materials.skeleton);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /** The table has changed. */
  changed(): void {
    this.stale = true;
  }

  /** Shows the axes of the table, or nothing. */
  show(table: TreeTable, shown: boolean): void {
    this.mesh.visible = shown && table.rows > 0;
    if (!this.mesh.visible || !this.stale) return;
    this.stale = false;
    const metamers = new Uint32Array(STRIDE * table.rows);
    let count = 0;
    for (let row = 0; row < table.rows; row += 1) {
      const parent = table.parent[row]!;
      if (parent < 0 || table.radiusCode[row] === 0) continue;
      metamers[STRIDE * count] = row;
      metamers[STRIDE * count + 1] = parent;
      count += 1;
    }
    this.geometry.dispose();
    this.geometry = strips(metamers.slice(0, STRIDE * count));
    this.mesh.geometry = this.geometry;
  }

  dispose(): void {
    this.geometry.dispose();
  }
}

function strips(metamers: Uint32Array): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("strip", new BufferAttribute(new Float32Array([-1, 0, 1, 0, -1, 1, 1, 1]), 2));
  geometry.setAttribute("metamer", new InstancedBufferAttribute(metamers, STRIDE));
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  geometry.instanceCount = metamers.length / STRIDE;
  return geometry;
}
