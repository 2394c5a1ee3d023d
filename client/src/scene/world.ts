import { type Mesh, Scene, Vector3, type WebGLRenderer } from "three";
import { type Appearance, DEFAULT_APPEARANCE } from "../wire/generated";
import { BrushShell } from "./brush-shell";
import { union } from "./camera/camera-rig";
import type { Box } from "./camera/camera-view";
import { extent } from "./camera/extent";
import type { Finer } from "./finer/finer";
import { Environment } from "./light/environment";
import { ShadowDue } from "./light/shadow-due";
import { Sun } from "./light/sun";
import { type Materials, makeMaterials, type Uniforms } from "./materials";
import type { DrawMode } from "./mode/draw-mode";
import { type Shown, USUAL } from "./mode/shown";
import { NoiseTextures } from "./noise-texture";
import { type DrawnObstacle, ObstacleMeshes } from "./obstacle-meshes";
import { Ghost } from "./overlay/ghost";
import type { Order } from "./painting/paint";
import { Painter } from "./painting/painter";
import type { TreeTable } from "./table/tree-table";
import { TreeView } from "./tree-view";

/** What a picture shows: the tree, what stands and shines around it, the brush and the ghost. */
export class World {
  readonly scene = new Scene();
  readonly uniforms: Uniforms;
  readonly painter: Painter;
  readonly tree: TreeView;
  readonly environment: Environment;
  readonly sun: Sun;
  readonly obstacles: ObstacleMeshes;
  readonly brush: BrushShell;
  readonly ghost: Ghost;
  readonly shadow = new ShadowDue();
  mode: DrawMode = "lit";
  shown: Shown = USUAL;
  /** What the first picture does without; null until it is loaded. */
  finer: Finer | null = null;
  appearance: Appearance = DEFAULT_APPEARANCE;
  readonly materials: Materials;
  /** Told when no texture can be painted, and the tree stays plain. */
  paintLost: () => void = () => {};
  private readonly noise = new NoiseTextures();

  /** `seen` are the uniforms of how it is looked at; `painted` is called when a texture has been painted, with what had been ordered. */
  constructor(
    readonly table: TreeTable,
    seen: Uniforms,
    painted: (order: Order) => void,
  ) {
    this.uniforms = {
      ...seen,
      uTime: { value: 0 },
      uLeafSize: { value: 0.7 },
      uShown: { value: new Vector3(1, 1, 1) },
      uNoise: { value: this.noise.space },
      uFlatNoise: { value: this.noise.plane },
    };
    this.painter = new Painter(painted, undefined, () => this.paintLost());
    this.sun = new Sun(this.uniforms);
    this.materials = makeMaterials(this.uniforms);
    this.tree = new TreeView(table, this.materials, this.uniforms, this.painter);
    this.environment = new Environment(this.materials, this.uniforms);
    this.obstacles = new ObstacleMeshes(this.materials);
    this.brush = new BrushShell(this.materials, this.uniforms);
    this.scene.add(...this.environment.meshes, this.tree.group, this.brush.mesh);
    this.ghost = new Ghost(this.uniforms);
    this.scene.add(this.obstacles.bodies, this.ghost.group);
    this.sun.casters.add(this.tree.casters, this.obstacles.casters);
  }

  /** What nearly every picture of a tree needs. */
  get essential(): readonly Mesh[] {
    return [...this.environment.meshes, ...this.tree.essential, ...this.sun.essential];
  }

  /** Has all textures painted that are drawn with, from now on. */
  paint(): void {
    this.painter.begun = true;
    this.tree.paint();
  }

  /** Whether something finer is there than what is shown. */
  get ripe(): boolean {
    return this.tree.ripe || this.finer?.ripe === true;
  }

  /** Whether something finer is still being made, or not yet shown. */
  get unfinished(): boolean {
    return (!this.painter.lost && this.tree.unfinished) || this.finer?.unfinished === true;
  }

  /** Whether something finer is being made that a picture for others waits for. */
  get awaited(): boolean {
    return (!this.painter.lost && this.tree.awaited) || this.finer?.awaited === true;
  }

  /** Shows what is finer in place of what is coarse; says whether shaders are others from now on. */
  ripen(): boolean {
    this.tree.ripen();
    return this.finer?.ripen() === true;
  }

  /** The tree's rows have changed. */
  changed(): void {
    this.shadow.stale = true;
    this.environment.update(this.table);
    this.finer?.changed();
  }

  /** How the tree and its surroundings look. */
  setAppearance(appearance: Appearance): void {
    this.appearance = appearance;
    this.environment.setBackground(appearance.background);
    this.tree.setAppearance(appearance);
    this.finer?.setAppearance(appearance);
    this.shadow.stale = true;
  }

  /** What is shown of the tree, and how. */
  show(mode: DrawMode, shown: Shown): void {
    this.mode = mode;
    this.shown = shown;
    const { light, smooth, texture, background } = shown;
    this.uniforms.uShown!.value.set(Number(light), Number(smooth), Number(texture));
    this.tree.show(mode, shown);
    this.environment.setNeutral(mode !== "lit" || !background);
    this.shadow.stale = true;
  }

  /** Whether anything is drawn in another way than usual. */
  get unusual(): boolean {
    return this.mode !== "lit" || this.shown !== USUAL;
  }

  /** Whether what is seen of the ground has grass on it. */
  get grassy(): boolean {
    const { light, texture, background } = this.shown;
    return this.mode === "lit" && light && texture && background;
  }

  /** Length of a leaf in internodes; false if it is the same as before. */
  setLeafSize(size: number): boolean {
    if (this.uniforms.uLeafSize!.value === size) return false;
    this.uniforms.uLeafSize!.value = size;
    this.shadow.stale = true;
    this.finer?.changed();
    return true;
  }

  /** Shows these obstacles and no others; one may be marked. */
  showObstacles(obstacles: readonly DrawnObstacle[], chosen: number | null): void {
    this.obstacles.show(obstacles, chosen);
    this.finer?.cover();
    this.shadow.stale = true;
  }

  /** The tree with what stands around it. */
  extent(): Box {
    return extent(this.table.bounds(), this.obstacles.bounds());
  }

  /** The same with the ghost. */
  reach(): Box {
    return this.withGhost(this.extent());
  }

  /** A box with the ghost, if there is one. */
  withGhost(box: Box): Box {
    const ghost = this.ghost.bounds();
    return ghost ? union(box, ghost) : box;
  }

  /** Draws the shadow map, with a share of its texels along each side. */
  drawShadow(renderer: WebGLRenderer, share = 1): void {
    if (!this.shown.shadow) return;
    this.sun.render(renderer, this.extent(), this.environment.towardsLight, share);
  }

  /** A restored context has lost every texture and buffer. */
  restored(): void {
    this.tree.restored();
    this.ghost.restored();
    this.finer?.restored();
    this.shadow.stale = true;
  }

  dispose(): void {
    const { tree, environment, obstacles, brush, ghost, noise, sun, painter } = this;
    for (const part of [tree, environment, obstacles, brush, ghost, noise, sun, painter]) part.dispose();
    this.finer?.dispose();
    for (const material of Object.values(this.materials)) material.dispose();
  }
}
