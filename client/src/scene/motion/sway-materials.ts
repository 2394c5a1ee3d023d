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
  private readonly pairs: Pair[];
  private readonly copies: Material[] = [];
  private preparing: Promise<void> | null = null;

  /** `drawn` are the groups of what is drawn; `pass` is drawn before them in each frame. */
  constructor(
    private readonly renderer: WebGLRenderer,
    drawn: readonly Object3D[],
    private readonly pass: Mesh,
  ) {
    const materials = new Set<RawShaderMaterial>();
    for (const group of drawn) {
      group.traverse((part) => {
        if (part instanceof Mesh && part.material instanceof RawShaderMaterial) materials.add(part.material);
      });
    }
    this.pairs = [...materials].map((material) => {
      const { vertexShader, fragmentShader } = material;
      const other = { vertexShader: swaying(vertexShader), fragmentShader: weathering(fragmentShader) };
      return { material, plain: { vertexShader, fragmentShader }, swaying: other };
    });
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
