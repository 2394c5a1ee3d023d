import { Mesh, SphereGeometry, Vector4 } from "three";
import type { Materials, Uniforms } from "./materials";
import type { Vec3 } from "./vector";

/** A brush without width still shows as a point of this share of its distance. */
const POINT_SHARE = 0.0045;

/** The sphere that shows the place and the radius of the brush. */
export class BrushShell {
  readonly mesh: Mesh;
  private readonly place = new Vector4();
  private readonly solid = { value: 0 };

  constructor(materials: Materials, uniforms: Uniforms) {
    uniforms.uBrush = { value: this.place };
    uniforms.uSolid = this.solid;
    this.mesh = new Mesh(new SphereGeometry(1, 48, 32), materials.brush);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = 3;
  }

  show(point: Vec3, radius: number, distance: number): void {
    const least = POINT_SHARE * distance;
    this.place.set(point[0], point[1], point[2], Math.max(radius, least));
    this.solid.value = radius < 2 * least ? 1 : 0;
    this.mesh.visible = true;
  }

  hide(): void {
    this.mesh.visible = false;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }
}
