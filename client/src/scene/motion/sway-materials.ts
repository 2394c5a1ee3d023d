import { type Material, Mesh, type Object3D, PerspectiveCamera, RawShaderMaterial, type WebGLRenderer } from "three";
import { swaying, weathering } from "./sway-shaders";

type Shaders = Readonly<Pick<RawShaderMaterial, "vertexShader" | "fragmentShader">>;

interface Pair {
  readonly material: RawShaderMaterial;
  readonly plain: Shaders;
  readonly swaying: Shaders;
}

/** What rows are drawn with, as they stand or as they sway; their programs for the latter are made when wind first blows. */
export class SwayMaterials {
  /** Whether every program is there. */
  ready = false;
  /** Whether rows are drawn as they sway. */
  swaying = false;
  private pairs: Pair[] = [];
  private readonly materials = new Set<RawShaderMaterial>();
  private readonly copies: Material[] = [];
  private preparing: Promise<void> | null = null;

  /** `drawn` are the groups of what is drawn; `pass` is drawn before them in each frame. */
  constructor(
    private readonly renderer: WebGLRenderer,
    drawn: readonly Object3D[],
    private readonly pass: Mesh,
  ) {
    for (const group of drawn) {
      group.traverse((part) => {
        if (part instanceof Mesh && part.material instanceof RawShaderMaterial) this.materials.add(part.material);
      });
    }
    this.renew();
  }

  /** The materials have other shaders from now on. */
  renew(): void {
    const renewed: Pair[] = [];
    for (const material of this.materials) {
      const { vertexShader, fragmentShader } = material;
      const before = this.pairs.find((pair) => pair.material === material);
      // One that is as it was stays what it is, also while it sways.
      if (before && [before.plain, before.swaying].some((shaders) => same(shaders, material))) {
        renewed.push(before);
        continue;
      }
      const other = { vertexShader: swaying(vertexShader), fragmentShader: weathering(fragmentShader) };
      renewed.push({ material, plain: { vertexShader, fragmentShader }, swaying: other });
    }
    this.pairs = renewed;
    this.ready = false;
    this.preparing = null;
    this.sway(false);
  }

  /** Has the programs made, once, while the picture goes on as it is. */
  prepare(): Promise<void> {
    this.preparing ??= this.compile();
    return this.preparing;
  }

  /** Draws rows as they sway from now on, or as they stand. */
  sway(sways: boolean): void {
    if (sways === this.swaying) return;
    this.swaying = sways;
    for (const { material, plain, swaying: other } of this.pairs) {
      Object.assign(material, sways ? other : plain);
      material.needsUpdate = true;
    }
  }

  dispose(): void {
    this.sway(false);
    for (const copy of this.copies) copy.dispose();
  }

  private async compile(): Promise<void> {
    const camera = new PerspectiveCamera();
    const cast = this.pairs.map(({ material, swaying: shader }) => {
      const { uniforms } = material;
      // Copied with it, each texture in them would become another one.
      material.uniforms = {};
      const copy = material.clone();
      material.uniforms = uniforms;
      copy.uniforms = uniforms;
      Object.assign(copy, shader);
      this.copies.push(copy);
      return new Mesh(this.pass.geometry, copy);
    });
    await Promise.all([...cast, this.pass].map((mesh) => this.renderer.compileAsync(mesh, camera)));
    this.ready = true;
  }
}

function same(a: Shaders, b: Shaders): boolean {
  return a.vertexShader === b.vertexShader && a.fragmentShader === b.fragmentShader;
}
