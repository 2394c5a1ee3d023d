import { Scene, Vector4, WebGLRenderer } from "three";
import type { Appearance, DrawingPlane } from "../wire/generated";
import { BrushShell } from "./brush-shell";
import type { Box, CameraPose } from "./camera/camera-pose";
import { CameraRig, fitted, union } from "./camera/camera-rig";
import { extent } from "./camera/extent";
import { type Pick, pickBranch } from "./camera/picking";
import { type PictureSize, pixelsPerInternode, Sight } from "./camera/sight";
import type { View } from "./camera/view";
import { Environment } from "./light/environment";
import { ShadowDue } from "./light/shadow-due";
import { Sun } from "./light/sun";
import { type Materials, makeMaterials, type Uniforms } from "./materials";
import type { DrawMode, Legend } from "./mode/draw-mode";
import { NoiseTextures } from "./noise-texture";
import { type DrawnObstacle, ObstacleMeshes } from "./obstacle-meshes";
import { Ghost, type GhostPose } from "./overlay/ghost";
import type { Overlay } from "./overlay/overlays";
import { Painter } from "./painting/painter";
import type { Fineness } from "./rendering/fineness";
import { FrameFence } from "./rendering/frame-fence";
import { drawsWithProcessor } from "./rendering/graphics-card";
import type { Tile } from "./rendering/picture-tiles";
import { followPixelRatio } from "./rendering/pixel-ratio";
import { OPENING, PICTURE_SAMPLES, QUALITIES, type Quality, QualityControl } from "./rendering/quality";
import { Rehearsal } from "./rendering/rehearsal";
import { RenderLoop, type RenderTime } from "./rendering/render-loop";
import { RenderPause } from "./rendering/render-pause";
import { Screen } from "./rendering/screen";
import type { TreeTable } from "./table/tree-table";
import { TreeView } from "./tree-view";
import type { Vec3 } from "./vector";

const MAX_PIXEL_RATIO = 2;
/** The same where the processor draws each of them. */
const MAX_CARDLESS_RATIO = 1;
/** Leaves and tips go on easing for this long after the last metamer has grown. */
const AFTERGROWTH_SECONDS = 0.6;
/** A line's width in pixels of the page. */
const LINE = 1.2;

/** The picture on a canvas: what is in it, the camera, and what a finger on it means. Draws only when needed. */
export class Viewport {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly sight = new Sight();
  private readonly rig = new CameraRig();
  private readonly uniforms: Uniforms = {};
  private readonly materials: Materials;
  private readonly noise = new NoiseTextures();
  private readonly painter = new Painter(() => this.loop.invalidate());
  private readonly tree: TreeView;
  private readonly environment: Environment;
  private readonly sun: Sun;
  private readonly obstacles: ObstacleMeshes;
  private readonly brush: BrushShell;
  private readonly ghost: Ghost;
  private readonly screen: Screen;
  private readonly loop: RenderLoop;
  private readonly pause: RenderPause;
  private readonly rehearsal: Rehearsal;
  private readonly resizing: ResizeObserver;
  private readonly unfollow: () => void;
  private readonly eye = new Vector4();
  private drawMode: DrawMode = "lit";
  /** Whether no tree has been shown yet. */
  private empty = true;
  /** What the last frame was worth. */
  private drawn = OPENING;
  /** Whether details are still to be chosen. */
  private unsettled = false;
  /** Whether the graphics card has taken its context away, and all that was drawn with it. */
  private lost = false;
  /** Whether a picture is being made of what the scene is now. */
  private posing = false;
  private readonly shadow = new ShadowDue();
  /** Whether the processor draws. */
  private readonly cardless: boolean;

  /**
   * Calls `lossChanged` with true when the picture is lost, and with false when it is back; `moved` when the view has
   * another place or size; `slowed` once it is slow as coarse as it gets, saying whether for want of a graphics card; and
   * `shown` with each frame that has a tree in it.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly table: TreeTable,
    private readonly lossChanged: (lost: boolean) => void = () => {},
    private readonly moved: () => void = () => {},
    private readonly slowed: (cardless: boolean) => void = () => {},
    private readonly shown: () => void = () => {},
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: false, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    // Asked for later, its answer would wait for all that is drawn by then.
    this.renderer.capabilities.getMaxAnisotropy();
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    this.cardless = drawsWithProcessor(gl);
    this.screen = new Screen(this.renderer, OPENING);
    this.uniforms.uTime = { value: 0 };
    this.uniforms.uLeafSize = { value: 0.7 };
    this.uniforms.uNoise = { value: this.noise.space };
    this.uniforms.uFlatNoise = { value: this.noise.plane };
    this.uniforms.uView = { value: this.eye };
    this.uniforms.uPicture = { value: this.screen.size };
    this.uniforms.uLine = { value: LINE };
    this.uniforms.uSamples = { value: this.screen.samples };
    this.uniforms.uWorldFromClip = { value: this.sight.worldFromClip };
    this.sun = new Sun(this.uniforms);
    this.materials = makeMaterials(this.uniforms);
    this.tree = new TreeView(this.table, this.materials, this.uniforms, this.painter);
    this.environment = new Environment(this.materials, this.uniforms);
    this.obstacles = new ObstacleMeshes(this.materials);
    this.brush = new BrushShell(this.materials, this.uniforms);
    this.scene.add(...this.environment.meshes, this.tree.group, this.brush.mesh);
    this.ghost = new Ghost(this.uniforms);
    this.scene.add(this.obstacles.bodies, this.ghost.group);
    this.sun.casters.add(this.tree.casters, this.obstacles.casters);
    this.loop = new RenderLoop(
      this.draw,
      () => this.loop.control.quality !== QUALITIES[0] || this.shadow.stale || this.tree.ripe,
      // Tests and scripts that take pictures of the page can read when this one is finished.
      (still) => canvas.toggleAttribute("data-still", still && this.complete),
      new FrameFence(gl),
      new QualityControl(this.cardless),
    );
    this.pause = new RenderPause(canvas, this.resume);
    this.loop.open();
    canvas.addEventListener("webglcontextlost", this.lose);
    canvas.addEventListener("webglcontextrestored", this.restored);
    const essential = [
      ...this.environment.meshes,
      ...this.tree.essential,
      ...this.sun.essential,
      ...this.screen.essential,
    ];
    this.rehearsal = new Rehearsal(this.renderer, essential, () => this.loop.open());
    this.resizing = new ResizeObserver(() => this.resize());
    this.resizing.observe(canvas);
    this.unfollow = followPixelRatio(() => this.resize());
    this.resize();
  }

  /** The table has changed; what is new is drawn with the next frame. */
  changed(): void {
    this.tree.changed();
    if (this.empty && this.table.rows > 0) {
      this.empty = false;
      this.painter.begun = true;
      this.loop.open();
    }
    this.loop.invalidate();
  }

  /** How the tree and its surroundings look. */
  setAppearance(appearance: Appearance): void {
    this.environment.setBackground(appearance.background);
    this.tree.setAppearance(appearance);
    this.shadow.stale = true;
    this.stir();
  }

  /** What is shown of the tree. */
  setDrawMode(mode: DrawMode): void {
    this.drawMode = mode;
    this.tree.setMode(mode);
    this.environment.setNeutral(mode !== "lit");
    this.shadow.stale = true;
    this.stir();
  }

  /** What the draw mode's colours mean, as the tree is now. */
  legend(): Legend | null {
    this.sync();
    return this.tree.legend;
  }

  /** Length of a leaf in internodes. */
  setLeafSize(size: number): void {
    if (this.uniforms.uLeafSize!.value === size) return;
    this.uniforms.uLeafSize!.value = size;
    this.shadow.stale = true;
    this.loop.invalidate();
  }

  /** Turns around the target. */
  orbit(dxPixels: number, dyPixels: number): void {
    this.rig.orbit(dxPixels, dyPixels);
    this.stir();
  }

  /** Turns to the front. */
  face(): void {
    this.rig.face();
    this.stir();
  }

  /** Moves the picture with the fingers. */
  pan(dxPixels: number, dyPixels: number): void {
    this.rig.pan(dxPixels, dyPixels, this.sight.height);
    this.stir();
  }

  /** Brings what is under a place on the canvas nearer (factor above 1) or further away. */
  zoom(factor: number, x: number, y: number): void {
    const { width, height } = this.sight;
    this.rig.zoom(factor, (2 * x - width) / height, 1 - (2 * y) / height);
    this.stir();
  }

  /** Eases the camera to a view of the whole tree and the ghost beside it; something may cover a share of the foot. */
  fitTree(covered = 0): void {
    const ghost = this.ghost.bounds();
    this.fitBox(ghost ? union(this.table.bounds(), ghost) : this.table.bounds(), covered);
  }

  /** Eases it to a view of what will be there. */
  fitBox(box: Box, covered = 0): void {
    this.rig.fit(box, this.sight.width / this.sight.height, covered);
    this.stir();
  }

  /** Shows the whole tree at once, as a view wants it. */
  look(view: View): void {
    this.rig.look(this.table.bounds(), this.sight.width / this.sight.height, view);
    this.stir();
  }

  /** Eases it back to where it was before the last fit, unless the user has moved it since. */
  restoreView(): void {
    this.rig.restore();
    this.stir();
  }

  /** How often the user has moved the camera. */
  get moves(): number {
    return this.rig.moves;
  }

  /** Whether the whole box is in the picture, once the camera has come where it goes. */
  frames(box: Box): boolean {
    return this.rig.frames(box, this.sight.width / this.sight.height);
  }

  /** Eases back until it is. */
  widen(box: Box): void {
    this.rig.widen(box, this.sight.width / this.sight.height);
    this.stir();
  }

  /** Whether it has done that, and the user has not moved the camera since. */
  get isWidened(): boolean {
    return this.rig.isWidened;
  }

  /** Eases to where it was before. */
  unwiden(): void {
    this.rig.unwiden();
    this.stir();
  }

  /** The radius of the largest brush around a point, or what the camera looks at, that stays in the picture. */
  widest(point: Vec3 = this.rig.pose.target): number {
    return this.aimed().widest(point);
  }

  /** Where a place on the canvas, in CSS pixels, lies in the plane that faces the camera and holds `through`. */
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null {
    return this.aimed().pointOnPlane(x, y, through);
  }

  /** Where it lies in the horizontal plane that holds `through`. */
  pointOnLevel(x: number, y: number, through: Vec3): Vec3 | null {
    return this.aimed().pointOnLevel(x, y, through);
  }

  /** The plane that faces the camera and holds `through`. */
  drawingPlane(through: Vec3): DrawingPlane {
    return this.aimed().drawingPlane(through);
  }

  /** What turns points of the world into places on the canvas, as the camera stands now. */
  projector(): (point: Vec3) => readonly [number, number] | null {
    return this.aimed().projector();
  }

  /** Whether a finger moves over the ground rather than up and down. */
  looksDown(): boolean {
    return this.aimed().looksDown();
  }

  /** The branch under or near a place on the canvas. */
  pick(x: number, y: number, tolerancePixels: number): Pick | null {
    const { overlays } = this.tree;
    const drawn = overlays.active ? overlays : null;
    return pickBranch(this.table, this.aimed().projection(), x, y, tolerancePixels, drawn);
  }

  /** Draws rows differently from the table until the table has caught up or the overlay is removed. */
  addOverlay(overlay: Overlay): void {
    this.tree.overlays.add(overlay);
    this.overlayChanged();
  }

  /** Draws the rows as the table has them again. */
  removeOverlay(overlay: Overlay): void {
    if (this.tree.overlays.remove(overlay)) this.overlayChanged();
  }

  hasOverlay(overlay: Overlay): boolean {
    return this.tree.overlays.has(overlay);
  }

  /** The content of a shown overlay has changed. */
  overlayChanged(): void {
    this.tree.overlayChanged();
    this.shadow.stale = true;
    this.stir();
  }

  /** Where a row is drawn. */
  placeOf(row: number): Vec3 {
    return this.tree.overlays.placeOf(this.table, row);
  }

  /** The obstacle under a place on the canvas. */
  pickObstacle(x: number, y: number): { id: number; point: Vec3 } | null {
    return this.obstacles.pick(this.aimed().rayAt(x, y));
  }

  /** How far an obstacle reaches below its own origin; null if it has no lowest point. */
  depthBelow(id: number): number | null {
    return this.obstacles.depthBelow(id);
  }

  /** Draws these obstacles and no others; one may be marked. */
  showObstacles(obstacles: readonly DrawnObstacle[], chosen: number | null): void {
    this.obstacles.show(obstacles, chosen);
    this.rig.keep(this.reach());
    this.shadow.stale = true;
    this.stir();
  }

  /** Shows rows of a table, or all of them, as a ghost; null for none. */
  showGhost(table: TreeTable | null, rows: Iterable<number> | null = null): void {
    if (table) this.ghost.show(table, rows);
    else this.ghost.hide();
    this.rig.keep(this.reach());
    this.stir();
  }

  /** Puts the ghost somewhere. */
  placeGhost(pose: GhostPose): void {
    this.ghost.place(pose);
    this.rig.keep(this.reach());
    this.stir();
  }

  /** A finger is down or a lever is held: the picture is not the one at rest until it is let go. */
  hold(held: boolean): void {
    this.loop.hold(held);
  }

  /** Shows the brush around some points. */
  showBrush(points: readonly Vec3[], radius: number): void {
    this.brush.show(points, radius, this.rig.eye());
    this.stir();
  }

  hideBrush(): void {
    this.brush.hide();
    this.stir();
  }

  /** A picture of the whole tree as a data URL of at most 192 KiB, if any can be drawn; too small for every detail. */
  async thumbnail(width: number, height: number): Promise<string | undefined> {
    const { encodePicture } = await import("./rendering/thumbnail");
    if (this.lost || this.posing) return undefined;
    const pose = fitted(this.table.bounds(), width / height, this.rig.pose.yaw);
    const passing = [this.brush.mesh, this.ghost.group].filter(({ visible }) => visible);
    for (const object of passing) object.visible = false;
    const mode = this.drawMode;
    if (mode !== "lit") this.setDrawMode("lit");
    this.sync();
    this.sight.aim(pose, this.rig.eye(pose), width / height);
    this.refine(height, PICTURE_SAMPLES, QUALITIES[1], pose.distance);
    if (this.shadow.stale) this.drawShadow();
    const picture = encodePicture(this.renderer, width, height, () => this.drawScene());
    for (const object of passing) object.visible = true;
    if (mode !== "lit") this.setDrawMode(mode);
    return picture;
  }

  /** Pixels of the picture across and down where the device draws all of them; null while there is none. */
  get pixels(): PictureSize | null {
    const { width, height } = this.sight;
    const ratio = Math.min(globalThis.devicePixelRatio, MAX_PIXEL_RATIO);
    return this.lost ? null : { width: Math.round(width * ratio), height: Math.round(height * ratio) };
  }

  /** The view as PNG, of so many pixels; what is on the canvas stands still meanwhile. */
  async picture(size: PictureSize, stop: AbortSignal, tell: (share: number) => void): Promise<Blob> {
    const { pictureInTiles } = await import("./rendering/picture-tiles");
    if (this.lost) throw new Error("There is no picture.");
    const [pose, eye] = [structuredClone(this.rig.pose), this.rig.eye()];
    this.sync();
    this.posing = true;
    try {
      return await pictureInTiles({
        renderer: this.renderer,
        ...size,
        stop,
        tell,
        draw: (tile) => this.drawTile(pose, eye, size, tile),
      });
    } finally {
      this.posing = false;
      this.shadow.stale = true;
      this.loop.invalidate();
    }
  }

  /** Lets go of the GPU and the canvas. */
  dispose(): void {
    this.loop.dispose();
    this.resizing.disconnect();
    this.unfollow();
    this.pause.dispose();
    this.canvas.removeEventListener("webglcontextlost", this.lose);
    this.canvas.removeEventListener("webglcontextrestored", this.restored);
    for (const part of [
      this.tree,
      this.environment,
      this.obstacles,
      this.brush,
      this.ghost,
      this.screen,
      this.noise,
      this.sun,
      this.painter,
    ])
      part.dispose();
    for (const material of Object.values(this.materials)) material.dispose();
    this.renderer.dispose();
  }

  /** Whether the picture has everything in it; while drawing pauses its textures are not waited for. */
  private get complete(): boolean {
    return !this.lost && this.rehearsal.prepared && (this.pause.on || !this.tree.unfinished);
  }

  /** Draws the whole picture after a pause, at once in the quality that is due. */
  private readonly resume = (): void => {
    const { scale, smooth } = this.loop.control.quality;
    this.screen.fit(scale, smooth);
    this.shadow.stale = true;
    this.loop.invalidate();
  };

  /** Draws again, as part of a movement. */
  private stir(): void {
    this.loop.stir();
  }

  private readonly draw = ({ began, step, asked }: RenderTime): boolean => {
    // What changes meanwhile is taken over once there is something to draw on.
    if (this.lost || this.posing || !this.rehearsal.prepare()) return false;
    const { control } = this.loop;
    // A finished picture comes over a lesser one without being drawn again, unless something happens meanwhile.
    const fades = asked || this.unsettled || !control.resting ? null : this.screen.fade(this.sight.camera);
    if (fades !== null) return fades;
    this.sync();
    const now = this.table.now();
    this.uniforms.uTime!.value = now;
    const growing = now < Math.max(this.table.settledAt + AFTERGROWTH_SECONDS, this.tree.glidesUntil);
    const moving = this.rig.step(step);
    if (growing || moving) control.moved(began);
    if (moving) this.moved();
    if (control.overtaxed) this.slowed(this.cardless);
    if (!this.empty) this.shown();
    if (this.pause.on) return growing || moving;
    const { quality } = control;
    const { camera } = this.aimed();
    // Finer textures wait for the picture at rest, which comes over that before it: nobody sees one put for another.
    const finer = control.resting && this.tree.ripe;
    const better = finer || (control.resting && quality !== this.drawn);
    const over = better && this.screen.remember(camera);
    if (finer) this.tree.ripen();
    this.shadow.stale ||= finer;
    this.screen.fit(quality.scale, quality.smooth);
    this.unsettled = this.refine(this.screen.size.y, this.screen.samples, quality);
    if (this.empty)
      this.rehearsal.play(() => {
        this.drawShadow();
        this.screen.rehearse(this.scene, camera);
      });
    if (this.shadow.take(began, quality.shadowEvery, growing, quality.detailed ? this.tree.merged : null))
      this.drawShadow();
    this.screen.draw(this.scene, camera, over);
    this.drawn = quality;
    return growing || moving || over || this.unsettled;
  };

  /** Chooses details for a picture of so many pixels in height from where the sight is aimed; says whether some are left. */
  private refine(height: number, samples: number, quality: Quality, distance = this.rig.pose.distance): boolean {
    const fineness = this.fineness(height, quality);
    this.eye.set(...fineness.eye, fineness.pixels);
    this.uniforms.uSamples!.value = samples;
    this.uniforms.uShadowTaps!.value = quality.detailed ? 3 : 1;
    this.environment.reach(distance);
    return this.tree.detail(fineness, this.loop.control.resting);
  }

  private fineness(height: number, { detailed, merging, leaves, sprigs, twigs }: Quality): Fineness {
    const { position } = this.sight.camera;
    const eye = [position.x, position.y, position.z] as const;
    return { eye, pixels: pixelsPerInternode(height), detailed, merging, leaves, sprigs, twigs };
  }

  /** Takes over what changed in the table. */
  private sync(): void {
    this.aimed();
    if (!this.tree.sync(this.fineness(this.screen.size.y, QUALITIES[0]))) return;
    this.shadow.stale = true;
    this.environment.update(this.table);
    this.rig.keep(this.reach());
  }

  private drawShadow(): void {
    this.sun.render(this.renderer, this.extent(), this.environment.towardsLight);
  }

  private drawTile(pose: CameraPose, eye: Vec3, size: PictureSize, tile: Tile): void {
    const brush = this.brush.mesh.visible;
    const shown = this.screen.size.clone();
    this.brush.mesh.visible = false;
    this.sight.aimAtTile(pose, eye, size, tile);
    this.refine(size.height, PICTURE_SAMPLES, QUALITIES[0], pose.distance);
    if (this.shadow.stale) {
      const target = this.renderer.getRenderTarget();
      this.drawShadow();
      this.renderer.setRenderTarget(target);
    }
    this.screen.size.set(tile.width, tile.height);
    this.drawScene();
    this.screen.size.copy(shown);
    this.brush.mesh.visible = brush;
    this.aimed();
  }

  private drawScene(): void {
    this.renderer.clear();
    this.renderer.render(this.scene, this.sight.camera);
  }

  /** The tree with what stands around it. */
  private extent(): Box {
    return extent(this.table.bounds(), this.obstacles.bounds());
  }

  /** What the camera keeps in reach. */
  private reach(): Box {
    const ghost = this.ghost.bounds();
    return ghost ? union(this.extent(), ghost) : this.extent();
  }

  private aimed(): Sight {
    this.sight.aim(this.rig.pose, this.rig.eye());
    return this.sight;
  }

  private resize(): void {
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.sight.width = width;
    this.sight.height = height;
    const ratio = Math.min(globalThis.devicePixelRatio, this.cardless ? MAX_CARDLESS_RATIO : MAX_PIXEL_RATIO);
    this.screen.resize(width, height, ratio);
    if (this.sun.fit(Math.max(width, height) * ratio)) this.shadow.stale = true;
    this.loop.invalidate();
    this.moved();
  }

  private readonly lose = (event: Event): void => {
    // Without this the browser would never restore it.
    event.preventDefault();
    this.lost = true;
    this.canvas.removeAttribute("data-still");
    this.lossChanged(true);
  };

  /** A restored context has lost every texture and buffer. */
  private readonly restored = (): void => {
    this.lost = false;
    this.screen.restored();
    this.tree.restored();
    this.ghost.restored();
    this.shadow.stale = true;
    this.loop.invalidate();
    this.lossChanged(false);
  };
}
