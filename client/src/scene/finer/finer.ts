import {
  BufferGeometry,
  DoubleSide,
  GLSL3,
  Mesh,
  type Object3D,
  PerspectiveCamera,
  RawShaderMaterial,
  type WebGLRenderer,
} from "three";
import type { Appearance, LeafKind } from "../../wire/generated";
import { BLADE_FRAGMENT, BLADE_VERTEX } from "../glsl/blades";
import { branchFragment } from "../glsl/branch";
import { CLAY } from "../glsl/clay";
import { CROWN_LIGHT, IN_CROWN } from "../glsl/crown";
import { groundFragment, skyFragment } from "../glsl/environment";
import { GROUND_SURFACE } from "../glsl/ground";
import { LANDSCAPE } from "../glsl/landscape";
import { leafFragment, leafVertex } from "../glsl/leaf";
import { obstacleFragment } from "../glsl/obstacle";
import { ornamentFragment, ornamentVertex } from "../glsl/ornament";
import { OLD_WOOD } from "../glsl/wood";
import type { Materials, Uniforms } from "../materials";
import type { Fineness } from "../rendering/fineness";
import type { TreeTable } from "../table/tree-table";
import { cloudDrift } from "./cloud-drift";
import { Crown } from "./crown";
import { Tufts } from "./tufts";

type Shaders = Partial<Pick<RawShaderMaterial, "vertexShader" | "fragmentShader">>;

/** How rough a blade's face is: what shines on laurel does not on a willow. */
const ROUGHNESS: Record<LeafKind, number> = {
  ovate: 0.44,
  round: 0.5,
  lanceolate: 0.58,
  lobed: 0.46,
  palmate: 0.5,
  fan: 0.55,
  compound: 0.56,
  needle: 0.5,
  scale: 0.6,
};

/** What a picture needs to become finer. */
export interface FinerStage {
  readonly renderer: WebGLRenderer;
  readonly table: TreeTable;
  readonly materials: Materials;
  /** What wood is drawn with, all of it alike. */
  readonly wood: readonly RawShaderMaterial[];
  readonly uniforms: Uniforms;
  readonly appearance: Appearance;
  /** What lies on the ground. */
  readonly obstacles: Object3D;
  /** Draws something more. */
  readonly add: (mesh: Mesh) => void;
  /** Called when something is ready to be shown. */
  readonly told: () => void;
}

/**
 * What the first picture does without: land to the horizon, clouds, grass, the crown's own light. It is loaded once that
 * picture is there, and comes over it when its programs are made and the crown's field is.
 */
export class Finer {
  private readonly crown: Crown;
  private readonly tufts: Tufts;
  private readonly rough = { value: 0.5 };
  private readonly drift = { value: 0 };
  private readonly changes: readonly (readonly [RawShaderMaterial, Shaders])[];
  private readonly copies: RawShaderMaterial[] = [];
  private linked = false;
  private shown = false;
  private grassy = false;
  private season = "";

  constructor(private readonly stage: FinerStage) {
    const { materials, uniforms, table } = stage;
    uniforms.uLeafRough = this.rough;
    uniforms.uCloudDrift = this.drift;
    this.crown = new Crown(table, uniforms, stage.told);
    const blade = new RawShaderMaterial({
      glslVersion: GLSL3,
      uniforms,
      vertexShader: BLADE_VERTEX,
      fragmentShader: BLADE_FRAGMENT,
      side: DoubleSide,
    });
    this.tufts = new Tufts(blade);
    const leaf = { vertexShader: leafVertex(IN_CROWN), fragmentShader: leafFragment(CROWN_LIGHT) };
    const wood = { fragmentShader: branchFragment(OLD_WOOD) };
    const clay = { fragmentShader: obstacleFragment(CLAY) };
    const ornament = (name: "Flower" | "Fruit") => ({
      vertexShader: ornamentVertex(name, IN_CROWN),
      fragmentShader: ornamentFragment(name, CROWN_LIGHT),
    });
    this.changes = [
      [materials.sky, { fragmentShader: skyFragment(LANDSCAPE) }],
      [materials.ground, { fragmentShader: groundFragment(GROUND_SURFACE) }],
      ...stage.wood.map((material) => [material, wood] as const),
      [materials.leaf, leaf],
      [materials.sprig, leaf],
      [materials.flower, ornament("Flower")],
      [materials.fruit, ornament("Fruit")],
      [materials.clay, clay],
      [materials.clayChosen, clay],
      [materials.clayClosed, clay],
      [materials.clayClosedChosen, clay],
      [materials.clayPlane, clay],
      [materials.clayPlaneChosen, clay],
    ];
    this.setAppearance(stage.appearance);
    this.changed();
    this.cover();
    void this.link(blade);
  }

  /** Whether something is ready that is not shown yet. */
  get ripe(): boolean {
    return this.crown.ripe && (this.linked || this.shown);
  }

  /** Whether something is still to come. */
  get unfinished(): boolean {
    return !this.shown || this.crown.unfinished;
  }

  /** Whether it is not ready to be shown for the first time. */
  get awaited(): boolean {
    return !this.shown && !this.ripe;
  }

  /** Shows what is ready; says whether shaders are others from now on. */
  ripen(): boolean {
    if (!this.ripe) return false;
    this.crown.ripen();
    if (this.shown) return false;
    this.shown = true;
    for (const [material, shaders] of this.changes) {
      Object.assign(material, shaders);
      material.needsUpdate = true;
    }
    this.stage.add(this.tufts.mesh);
    return true;
  }

  /** The tree has changed, or how long its leaves are. */
  changed(): void {
    this.crown.changed();
  }

  /** What lies on the ground is elsewhere. */
  cover(): void {
    this.tufts.cover(this.stage.obstacles.children);
  }

  /** How the tree and its surroundings look. */
  setAppearance(appearance: Appearance): void {
    const season = `${appearance.leaves.shape} ${appearance.leaves.season}`;
    if (season !== this.season) this.crown.changed();
    this.season = season;
    this.rough.value = ROUGHNESS[appearance.leaves.shape];
    this.drift.value = cloudDrift(appearance.background);
    const { ground, sky } = appearance.background;
    this.grassy = ground !== "plain" && sky !== "studio";
    this.tufts.sparse = ground !== "grass";
  }

  /** Chooses what is drawn of the grass, for a picture that stays or one that moves. */
  detail(fineness: Fineness, camera: PerspectiveCamera, stays: boolean): void {
    this.tufts.detail(fineness, camera, this.shown && stays && this.grassy);
  }

  /** A restored context has lost every texture. */
  restored(): void {
    this.crown.restored();
    this.tufts.restored();
  }

  dispose(): void {
    this.crown.dispose();
    this.tufts.dispose();
    for (const copy of this.copies) copy.dispose();
  }

  /** Has the programs made while the picture goes on as it is: with copies, which share them. */
  private async link(blade: RawShaderMaterial): Promise<void> {
    const { renderer, told } = this.stage;
    const [camera, geometry] = [new PerspectiveCamera(), new BufferGeometry()];
    const cast = this.changes.map(([material, shaders]) => {
      const { uniforms } = material;
      // Copied with it, each texture in them would become another one.
      material.uniforms = {};
      const copy = material.clone();
      material.uniforms = uniforms;
      this.copies.push(copy);
      return Object.assign(copy, shaders, { uniforms });
    });
    this.copies.push(blade);
    await Promise.all([...cast, blade].map((material) => renderer.compileAsync(new Mesh(geometry, material), camera)));
    this.linked = true;
    told();
  }
}
