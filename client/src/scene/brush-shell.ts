import { InstancedBufferGeometry, Mesh, SphereGeometry, Vector4 } from "three";
import { MOST_BRUSHES } from "./glsl/environment";
import type { Materials, Uniforms } from "./materials";
import type { Vec3 } from "./vector";

/** A brush without width still shows as a point of this share of its distance. */
const POINT_SHARE = 0.0045;

/** The spheres that show the places and the radius of the brush. */
export class BrushShell {
  readonly mesh: Mesh<InstancedBufferGeometry>;
  private readonly places = Array.from({ length: MOST_BRUSHES }, () => new Vector4());
  private readonly solid = { value: 0 };

  constructor(materials: Materials, uniforms: Uniforms) {
    uniforms.uBrush = { value: this.places };
    uniforms.uSolid = this.solid;
    const sphere = new SphereGeometry(1, 48, 32);
    const geometry = new InstancedBufferGeometry();
    geometry.setIndex(sphere.getIndex());
    geometry.setAttribute("position", sphere.getAttribute("position"));
    this.mesh = new Mesh(geometry, materials.brush);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = 3;
  }

  /** Shows it at some places, seen from `eye`; the first counts for whether it is no more than a point. */
  show(points: readonly Vec3[], radius: number, eye: Vec3): void {
    const shown = points.slice(0, MOST_BRUSHES);
    shown.forEach(([x, y, z], i) => {
      const least = POINT_SHARE * Math.hypot(x - eye[0], y - eye[1], z - eye[2]);
      this.places[i]!.set(x, y, z, Math.max(radius, least));
      if (i === 0) this.solid.value = radius < 2 * least ? 1 : 0;
    });
    this.mesh.geometry.instanceCount = shown.length;
    this.mesh.visible = shown.length > 0;
  }

  /** Its first place and its radius, while it is shown. */
  get shown(): readonly [number, number, number, number] | null {
    const { x, y, z, w } = this.places[0]!;
    return this.mesh.visible ? [x, y, z, w] : null;
  }

  hide(): void {
    this.mesh.visible = false;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }
}
