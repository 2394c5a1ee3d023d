import { BufferAttribute, BufferGeometry, CircleGeometry, Mesh, Vector4 } from "three";
import type { Materials, Uniforms } from "./materials";
import { radiusOf, type TreeTable } from "./tree-table";

const GROUND_RADIUS = 600;
const MAX_FEET = 8;

/** Sky and ground. */
export class Environment {
  readonly meshes: Mesh[];
  private readonly feet = Array.from({ length: MAX_FEET }, () => new Vector4());
  private readonly crown = new Vector4(0, 0, 1, 0);

  constructor(materials: Materials, uniforms: Uniforms) {
    uniforms.uFeet = { value: this.feet };
    uniforms.uCrown = { value: this.crown };
    const sky = new Mesh(new BufferGeometry(), materials.sky);
    sky.geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const ground = new Mesh(new CircleGeometry(GROUND_RADIUS, 64).rotateX(-Math.PI / 2), materials.ground);
    // After the tree and in this order, so that what is hidden is never shaded.
    ground.renderOrder = 1;
    sky.renderOrder = 2;
    this.meshes = [sky, ground];
    for (const mesh of this.meshes) mesh.frustumCulled = false;
  }

  /** Lets the ground know where trunks stand and how far the crown reaches. */
  update(table: TreeTable): void {
    let found = 0;
    for (const foot of this.feet) foot.w = 0;
    for (let row = 0; row < table.rows && found < MAX_FEET; row += 1) {
      if (table.parent[row]! >= 0) continue;
      const first = table.successor[row]!;
      const radius = first < 0 ? 0 : radiusOf(table.radiusCode[first]!);
      this.feet[found]!.set(table.position[3 * row]!, 0, table.position[3 * row + 2]!, radius);
      found += 1;
    }
    const { min, max } = table.bounds();
    const reach = 0.5 * Math.max(max[0] - min[0], max[2] - min[2]);
    this.crown.set((min[0] + max[0]) / 2, (min[2] + max[2]) / 2, Math.max(1, reach), Math.min(1, reach / 8));
  }

  dispose(): void {
    for (const mesh of this.meshes) mesh.geometry.dispose();
  }
}
