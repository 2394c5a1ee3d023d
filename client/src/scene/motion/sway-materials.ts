import { type Material, Mesh, type Object3D, PerspectiveCamera, RawShaderMaterial, type WebGLRenderer } from "three";
import { swaying, weathering } from "./sway-shaders";

type Shaders = Readonly<Pick<RawShaderMaterial, "vertexShader" | "fragmentShader">>;

interface Pair {
  readonly material: RawShaderMaterial;
  readonly plain: Shaders;
  /** Those that it sways with, and others that it is to sway with once there are programs for them. */
  swaying: Shaders;
  coming: Shaders | null;
}

/** What rows are drawn with, as they stand or as they sway; their programs for the latter are made when wind first blows. */
export class SwayMaterials {
  /** Whether every program is there. */
  complete = false;
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

  /** Whether rows can be drawn as they sway: what does so already goes on as it is. */
  get ready(): boolean {
    return this.complete || this.swaying;
  }

  /** The materials have other shaders from now on. What sways goes on with those of before until there are programs for others. */
  renew(): void {
    const renewed: Pair[] = [];
    for (const material of this.materials) {
      const before = this.pairs.find((pair) => pair.material === material);
      const plain = before ? plainOf(material, before) : shadersOf(material);
      if (before && same(plain, before.plain)) {
        renewed.push(before);
        continue;
      }
      const coming = { vertexShader: swaying(plain.vertexShader), fragmentShader: weathering(plain.fragmentShader) };
      const now = before?.swaying ?? coming;
      renewed.push({ material, plain, swaying: now, coming });
      if (this.swaying) dress(material, now);
    }
    this.pairs = renewed;
    this.complete = false;
    this.preparing = null;
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
    for (const { material, plain, swaying: other } of this.pairs) dress(material, sways ? other : plain);
  }

  dispose(): void {
    this.sway(false);
    for (const copy of this.copies) copy.dispose();
  }

  private async compile(): Promise<void> {
    const camera = new PerspectiveCamera();
    const { pairs } = this;
    const changed = pairs.filter(({ coming }) => coming);
    const cast = changed.map(({ material, coming }) => {
      const { uniforms } = material;
      // Copied with it, each texture in them would become another one.
      material.uniforms = {};
      const copy = material.clone();
      material.uniforms = uniforms;
      copy.uniforms = uniforms;
      Object.assign(copy, coming);
      this.copies.push(copy);
      return new Mesh(this.pass.geometry, copy);
    });
    await Promise.all([...cast, this.pass].map((mesh) => this.renderer.compileAsync(mesh, camera)));
    // Shaders that were changed meanwhile have programs of their own made.
    if (this.pairs !== pairs) return;
    for (const pair of changed) {
      pair.swaying = pair.coming!;
      pair.coming = null;
      if (this.swaying) dress(pair.material, pair.swaying);
    }
    this.complete = true;
  }
}

function dress(material: RawShaderMaterial, shaders: Shaders): void {
  Object.assign(material, shaders);
  material.needsUpdate = true;
}

function shadersOf({ vertexShader, fragmentShader }: Shaders): Shaders {
  return { vertexShader, fragmentShader };
}

/** What a material has that was changed, perhaps one of its shaders alone and while it sways. */
function plainOf(material: Shaders, { plain, swaying }: Pair): Shaders {
  const of = (name: keyof Shaders) => (material[name] === swaying[name] ? plain[name] : material[name]);
  return { vertexShader: of("vertexShader"), fragmentShader: of("fragmentShader") };
}

function same(a: Shaders, b: Shaders): boolean {
  return a.vertexShader === b.vertexShader && a.fragmentShader === b.fragmentShader;
}
