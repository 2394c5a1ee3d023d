import { type Object3D, type Scene, Vector4, WebGLRenderer } from "three";
import type { Appearance, DrawingPlane } from "../wire/generated";
import { type Pick, pickBranch } from "./camera/picking";
import { type PictureSize, pixelsPerInternode } from "./camera/sight";
import { ViewCamera } from "./camera/view-camera";
import type { DrawMode, Legend } from "./mode/draw-mode";
import type { Shown } from "./mode/shown";
import type { Air, AirStage } from "./motion/air";
import type { DrawnObstacle } from "./obstacle-meshes";
import type { GhostPlacement } from "./overlay/ghost";
import type { Overlay } from "./overlay/overlays";
import type { Fineness } from "./rendering/fineness";
import { FrameFence } from "./rendering/frame-fence";
import { drawsWithProcessor } from "./rendering/graphics-card";
import { followPixelRatio } from "./rendering/pixel-ratio";
import { openingOf, QUALITIES, type Quality, QualityControl } from "./rendering/quality";
import { Rehearsal } from "./rendering/rehearsal";
import { RenderLoop, type RenderTime } from "./rendering/render-loop";
import { RenderPause } from "./rendering/render-pause";
import { Screen } from "./rendering/screen";
import type { Sketch } from "./rendering/sketch";
import type { Sitting } from "./rendering/still-pictures";
import type { Dyed } from "./table/row-dyes";
import type { TreeTable } from "./table/tree-table";
import type { Ray, Vec3 } from "./vector";
import { World } from "./world";

const MAX_PIXEL_RATIO = 2;
/** The same where the processor draws each of them. */
const MAX_CARDLESS_RATIO = 1;
/** Rows of a tree whose picture is sure to be coarse there. */
const LARGE = 10_000;
/** What draws such a tree as lines is waited for so long at most, in milliseconds: it may never come. */
const SKETCHED_BY = 10_000;
/** A picture for others waits at most so many milliseconds for what is finer, and looks whether it is there as often. */
const [WHOLE_BY, WHOLE_EVERY] = [10_000, 50] as const;
/** Frames in which nothing else is asked for after it: what is asked for next may keep it from the screen for seconds. */
const SKETCH_FRAMES = 4;
/** Leaves and tips go on easing for this long after the last metamer has grown. */
const AFTERGROWTH_SECONDS = 0.6;
/** A line's width in pixels of the page. */
const LINE = 1.2;

const after = (milliseconds: number) => new Promise<null>((resolve) => setTimeout(resolve, milliseconds, null));

/** The picture on a canvas: what is in it, the camera, and what a finger on it means. Draws only when needed. */
export class Viewport {
  /** Where it is seen from; fingers move it, and what is to be shown. */
  readonly camera: ViewCamera;
  private readonly renderer: WebGLRenderer;
  private readonly world: World;
  private readonly screen: Screen;
  private readonly loop: RenderLoop;
  private readonly pause: RenderPause;
  private readonly rehearsal: Rehearsal;
  /** The first sight of a large tree where the processor draws, as it comes; null where nothing is to be sketched any more. */
  private sketch: Promise<Sketch | null> | Sketch | null = null;
  private readonly resizing: ResizeObserver;
  private readonly unfollow: () => void;
  private readonly eye = new Vector4();
  /** Whether no tree has been shown yet. */
  private empty = true;
  /** Frames for which the sketch is left alone. */
  private sketchStays = 0;
  /** What the last frame was worth. */
  private drawn: Quality;
  /** Whether details are still to be chosen. */
  private unsettled = false;
  /** Whether what the first picture does without is being loaded; null while that is not wanted. */
  private loading: boolean | null = null;
  private gone = false;
  /** What moves the tree; null as long as no wind has blown. */
  air: Air | null = null;
  /** Whether the graphics card has taken its context away, and all that was drawn with it. */
  private lost = false;
  /** Whether a picture is being made of what the scene is now. */
  private posing = false;
  /** Whether the processor draws. */
  readonly cardless: boolean;

  /**
   * Calls `lossChanged` with true when the picture is lost, and with false when it is back; `moved` when the view has
   * another place or size; `slowed` once it is slow as coarse as it gets, saying whether for want of a graphics card, and
   * for want of one as soon as a large tree has come; `shown` with each frame that has a tree in it; and `words`
   * for what a large tree waits for then: that it can be said why it is slow.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly table: TreeTable,
    private readonly lossChanged: (lost: boolean) => void = () => {},
    private readonly moved: () => void = () => {},
    private readonly slowed: (cardless: boolean) => void = () => {},
    private readonly shown: () => void = () => {},
    private readonly words: () => Promise<unknown> = async () => {},
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: false, powerPreference: "high-performance" });
    this.renderer.autoClear = false;
    // Asked for later, its answer would wait for all that is drawn by then.
    this.renderer.capabilities.getMaxAnisotropy();
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    this.cardless = drawsWithProcessor(gl);
    this.drawn = openingOf(this.cardless);
    this.screen = new Screen(this.renderer, this.drawn);
    this.camera = new ViewCamera({
      tree: () => table.bounds(),
      shown: () => this.world.withGhost(table.bounds()),
      stirred: () => this.stir(),
    });
    const seen = {
      uView: { value: this.eye },
      uPicture: { value: this.screen.size },
      uLine: { value: LINE },
      uSamples: { value: this.screen.samples },
      uWorldFromClip: { value: this.camera.sight.worldFromClip },
    };
    this.world = new World(table, seen, ({ coarse }) => {
      // Leaves cast shadows from their first picture on; the whole one is shown when the time is right.
      if (coarse) this.world.shadow.stale = true;
      this.loop.invalidate();
    });
    this.loop = new RenderLoop(
      this.draw,
      () => this.loop.control.quality !== QUALITIES[0] || this.world.shadow.isDue || this.world.ripe,
      // Tests and scripts that take pictures of the page can read when this one is finished.
      (still) => canvas.toggleAttribute("data-still", still && this.complete),
      new FrameFence(gl),
      new QualityControl(this.cardless),
    );
    this.pause = new RenderPause(canvas, this.resume);
    this.loop.open();
    canvas.addEventListener("webglcontextlost", this.lose);
    canvas.addEventListener("webglcontextrestored", this.restored);
    if (this.cardless) void this.prepareSketch();
    const essential = [...this.world.essential, ...this.screen.essential];
    this.rehearsal = new Rehearsal(this.renderer, essential, () => this.loop.open());
    // The processor makes one program after the other: there the sketch goes before them.
    if (!this.cardless) this.rehearsal.begin();
    this.resizing = new ResizeObserver(() => this.resize());
    this.resizing.observe(canvas);
    this.unfollow = followPixelRatio(() => this.resize());
    this.resize();
  }

  /** The table has changed; what is new is drawn with the next frame. */
  changed(): void {
    this.world.tree.changed();
    if (this.empty && this.table.rows > 0) {
      this.empty = false;
      if (!this.pause.on) this.world.paint();
      this.loop.open();
    }
    if (this.cardless && this.table.rows > LARGE) this.slowed(true);
    this.loop.invalidate();
  }

  /** How the tree and its surroundings look. */
  setAppearance(appearance: Appearance): void {
    this.world.setAppearance(appearance);
    this.stir();
  }

  /** The colours that branches have of their own. */
  setDyes(dyed: Dyed): void {
    this.world.tree.setDyes(dyed);
    this.stir();
  }

  /** Whether the picture at rest is the whole one also where that takes long. */
  setThorough(thorough: boolean): void {
    this.loop.control.thorough = thorough;
    this.stir();
  }

  /** What is shown of the tree. */
  show(mode: DrawMode, shown: Shown): void {
    this.world.show(mode, shown);
    this.stir();
  }

  /** What the draw mode's colours mean, as the tree is now. */
  legend(): Legend | null {
    this.sync();
    return this.world.tree.legend;
  }

  /** Length of a leaf in internodes. */
  setLeafSize(size: number): void {
    if (this.world.setLeafSize(size)) this.loop.invalidate();
  }

  /** The radius of the largest brush around a point, or what the camera looks at, that stays in the picture. */
  widest(point: Vec3 = this.camera.rig.view.target): number {
    return this.camera.aimed().widest(point);
  }

  /** Where a place on the canvas, in CSS pixels, lies in the plane that faces the camera and holds `through`. */
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null {
    return this.camera.aimed().pointOnPlane(x, y, through);
  }

  /** Where it lies in the horizontal plane that holds `through`. */
  pointOnLevel(x: number, y: number, through: Vec3): Vec3 | null {
    return this.camera.aimed().pointOnLevel(x, y, through);
  }

  /** The plane that faces the camera and holds `through`. */
  drawingPlane(through: Vec3): DrawingPlane {
    return this.camera.aimed().drawingPlane(through);
  }

  /** What turns points of the world into places on the canvas, as the camera stands now. */
  projector(): (point: Vec3) => readonly [number, number] | null {
    return this.camera.aimed().projector();
  }

  /** Whether a finger moves over the ground rather than up and down. */
  looksDown(): boolean {
    return this.camera.aimed().looksDown();
  }

  /** The branch under or near a place on the canvas. */
  pick(x: number, y: number, tolerancePixels: number): Pick | null {
    const { overlays } = this.world.tree;
    const drawn = overlays.active ? overlays : null;
    const sight = this.camera.aimed().projection();
    return this.air
      ? this.air.pick(sight, x, y, tolerancePixels, drawn)
      : pickBranch(this.table, sight, x, y, tolerancePixels, drawn);
  }

  /** Calls it once no texture can be painted. */
  onPaintLost(lost: () => void): void {
    this.world.paintLost = () => {
      lost();
      this.loop.invalidate();
    };
  }

  /** Has something move the tree from now on. */
  enliven(make: (stage: AirStage) => Air): Air {
    const { renderer, world, loop } = this;
    this.air ??= make({ renderer, world, control: loop.control, invalidate: () => loop.invalidate() });
    return this.air;
  }

  /** What draws something more in the picture needs of it. */
  get backstage(): { readonly scene: Scene; readonly stir: () => void } {
    return { scene: this.world.scene, stir: () => this.stir() };
  }

  /** From the eye through a place on the canvas. */
  rayAt(x: number, y: number): Ray {
    return this.camera.aimed().rayAt(x, y);
  }

  /** Draws rows differently from the table until the table has caught up or the overlay is removed. */
  addOverlay(overlay: Overlay): void {
    this.world.tree.overlays.add(overlay);
    this.overlayChanged();
  }

  /** Draws the rows as the table has them again. */
  removeOverlay(overlay: Overlay): void {
    if (this.world.tree.overlays.remove(overlay)) this.overlayChanged();
  }

  hasOverlay(overlay: Overlay): boolean {
    return this.world.tree.overlays.has(overlay);
  }

  /** The content of a shown overlay has changed. */
  overlayChanged(): void {
    this.world.tree.overlayChanged();
    this.world.shadow.stale = true;
    this.stir();
  }

  /** Where a row is drawn while no wind moves it. */
  placeOf(row: number): Vec3 {
    return this.world.tree.overlays.placeOf(this.table, row);
  }

  /** Where a row is seen, in the wind as well. */
  seenAt(row: number): Vec3 {
    return this.air?.seenAt(row, this.world.tree.overlays) ?? this.placeOf(row);
  }

  /** The obstacle under a place on the canvas. */
  pickObstacle(x: number, y: number): { id: number; point: Vec3 } | null {
    return this.world.obstacles.pick(this.rayAt(x, y));
  }

  /** How far an obstacle reaches below its own origin; null if it has no lowest point. */
  depthBelow(id: number): number | null {
    return this.world.obstacles.depthBelow(id);
  }

  /** Draws these obstacles and no others; one may be marked. */
  showObstacles(obstacles: readonly DrawnObstacle[], chosen: number | null): void {
    this.world.showObstacles(obstacles, chosen);
    this.reachedAnew();
  }

  /** Shows rows of a table, or all of them, as a ghost; null for none. */
  showGhost(table: TreeTable | null, rows: Iterable<number> | null = null): void {
    if (table) this.world.ghost.show(table, rows);
    else this.world.ghost.hide();
    this.reachedAnew();
  }

  /** Puts the ghost somewhere. */
  placeGhost(placement: GhostPlacement): void {
    this.world.ghost.place(placement);
    this.reachedAnew();
  }

  /** A finger is down or a lever is held: the picture is not the one at rest until it is let go. */
  hold(held: boolean): void {
    this.loop.hold(held);
  }

  /** Shows the brush around some points. */
  showBrush(points: readonly Vec3[], radius: number): void {
    this.world.brush.show(points, radius, this.camera.rig.eye());
    this.stir();
  }

  /** The first place of the brush and its radius, while it is shown. */
  get brush(): readonly [number, number, number, number] | null {
    return this.world.brush.shown;
  }

  hideBrush(): void {
    this.world.brush.hide();
    this.stir();
  }

  /** A picture of the whole tree as a data URL of at most 192 KiB, if any can be drawn; too small for every detail. */
  async thumbnail(width: number, height: number): Promise<string | undefined> {
    const { thumbnail } = await import("./rendering/still-pictures");
    if (this.lost || this.posing) return undefined;
    const url = thumbnail(this.sitting, width, height);
    if (this.world.unusual) this.stir();
    return await url;
  }

  /** Pixels of the picture across and down where the device draws all of them; null while there is none. */
  get pixels(): PictureSize | null {
    const { width, height } = this.camera.sight;
    const ratio = Math.min(globalThis.devicePixelRatio, MAX_PIXEL_RATIO);
    return this.lost ? null : { width: Math.round(width * ratio), height: Math.round(height * ratio) };
  }

  /** The view as PNG, of so many pixels; what is on the canvas stands still meanwhile. */
  async picture(size: PictureSize, stop: AbortSignal, tell: (share: number) => void): Promise<Blob> {
    const { picture } = await import("./rendering/still-pictures");
    await this.untilWhole(stop);
    if (this.lost) throw new Error("There is no picture.");
    this.posing = true;
    try {
      if (this.world.ripen()) this.air?.redress();
      this.world.shadow.stale = true;
      return await picture(this.sitting, size, stop, tell);
    } finally {
      this.posing = false;
      this.world.shadow.stale = true;
      this.loop.invalidate();
    }
  }

  /** Waits for what the picture on the canvas will have in the end, though not for a tree that goes on growing. */
  private async untilWhole(stop: AbortSignal): Promise<void> {
    if (!this.empty) {
      this.world.paint();
      void this.loadFiner();
    }
    for (let waited = 0; waited < WHOLE_BY && (this.loading || this.world.awaited); waited += WHOLE_EVERY) {
      stop.throwIfAborted();
      await after(WHOLE_EVERY);
    }
    stop.throwIfAborted();
  }

  private get sitting(): Sitting {
    const { renderer, world, camera, screen } = this;
    const refine: Sitting["refine"] = (...picture) => void this.refine(...picture, true);
    return { renderer, world, camera, screen, sync: () => this.sync(), refine };
  }

  /** Lets go of the GPU and the canvas. */
  dispose(): void {
    this.gone = true;
    this.loop.dispose();
    this.air?.dispose();
    this.resizing.disconnect();
    this.unfollow();
    this.pause.dispose();
    this.canvas.removeEventListener("webglcontextlost", this.lose);
    this.canvas.removeEventListener("webglcontextrestored", this.restored);
    this.screen.dispose();
    this.world.dispose();
    this.renderer.dispose();
  }

  /** Whether the picture has everything in it; while drawing pauses its textures are not waited for. */
  private get complete(): boolean {
    return !this.lost && this.rehearsal.prepared && (this.pause.on || !(this.loading || this.world.unfinished));
  }

  /** Draws the whole picture after a pause, at once in the quality that is due. */
  private readonly resume = (): void => {
    const { scale, smooth } = this.loop.control.quality;
    this.screen.fit(scale, smooth);
    this.world.shadow.stale = true;
    if (!this.empty) this.world.paint();
    this.loop.invalidate();
  };

  /** The camera keeps in reach what is there now. */
  private reachedAnew(): void {
    this.camera.rig.keep(this.world.reach());
    this.stir();
  }

  /** Draws again, as part of a movement. */
  private stir(): void {
    this.loop.stir();
  }

  private readonly draw = ({ began, step, asked }: RenderTime): boolean => {
    // What changes meanwhile is taken over once there is something to draw on.
    if (this.lost || this.posing) return false;
    const sketched = this.sketched(step);
    if (sketched !== null) return sketched;
    if (!this.empty) this.rehearsal.begin();
    if (!this.rehearsal.prepare()) return false;
    const { control } = this.loop;
    // A finished picture comes over a lesser one without being drawn again, unless something happens meanwhile.
    const fades = asked || this.unsettled || !control.resting ? null : this.screen.fade(this.camera.sight.camera);
    if (fades !== null) return fades;
    if (!asked && control.resting && this.air?.early(began)) return true;
    this.sync();
    const now = this.table.now();
    this.world.uniforms.uTime!.value = now;
    const growing = now < Math.max(this.table.settledAt + AFTERGROWTH_SECONDS, this.world.tree.glidesUntil);
    const moving = this.camera.rig.step(step);
    if (growing || moving) control.moved(began);
    if (moving) this.moved();
    const sways = !this.pause.on && this.air?.step(began);
    if (control.overtaxed) this.slowed(this.cardless);
    if (!this.empty) {
      this.sketch = null;
      this.shown();
    }
    if (this.pause.on) return growing || moving;
    if (!this.empty) void this.loadFiner();
    const { quality } = control;
    const { camera } = this.camera.aimed();
    // Finer textures wait for the picture at rest, which comes over that before it: nobody sees one put for another.
    const finer = control.resting && this.world.ripe;
    const better = finer || (control.resting && quality !== this.drawn);
    const over = better && !sways && this.screen.remember(camera);
    if (finer && this.world.ripen()) {
      this.air?.redress();
      control.forget();
      // How long such a picture takes, the next one tells.
      if (control.rising) this.loop.invalidate();
    }
    this.world.shadow.stale ||= finer;
    this.screen.fit(quality.scale, quality.smooth);
    this.unsettled = this.refine(this.screen.size.y, this.screen.samples, quality);
    if (this.empty)
      this.rehearsal.play(() => {
        this.world.drawShadow(this.renderer, quality.shadows);
        this.screen.rehearse(this.world.scene, camera);
      });
    const { shadowEvery, shadows } = quality;
    const merged = quality.detailed ? this.world.tree.merged : null;
    if (this.world.shadow.take(began, shadowEvery, growing, merged, shadows))
      this.world.drawShadow(this.renderer, shadows);
    this.screen.draw(this.world.scene, camera, over);
    this.drawn = quality;
    return growing || moving || over || this.unsettled || sways === true;
  };

  /** Loads what the first picture does without; where that cannot be had, the picture stays as it is. */
  private async loadFiner(): Promise<void> {
    if (this.loading !== null) return;
    this.loading = true;
    const { renderer, table, world } = this;
    const { materials, uniforms, appearance } = world;
    const { wood } = world.tree;
    const obstacles = world.obstacles.bodies;
    const told = () => this.loop.invalidate();
    const add = (mesh: Object3D) => world.scene.add(mesh);
    const made = await import("./finer/finer").catch(() => null);
    if (made && !this.gone)
      world.finer = new made.Finer({ renderer, table, materials, wood, uniforms, appearance, obstacles, add, told });
    this.loading = false;
    if (!this.gone) told();
  }

  /** Loads what draws a large tree as lines. */
  private async prepareSketch(): Promise<void> {
    const drawn = import("./rendering/sketch").then(({ sketch }) => sketch(this.sitting));
    const coming = Promise.race([Promise.all([drawn, this.words()]).then(([sketch]) => sketch), after(SKETCHED_BY)]);
    this.sketch = coming;
    const made = await coming.catch(() => null);
    if (this.sketch === coming) this.sketch = made;
    this.loop.open();
  }

  /** Draws a large tree as lines if that is its first sight, and says whether more is to be drawn after it; null where it is not wanted. */
  private sketched(step: number): boolean | null {
    const { sketch } = this;
    if (this.sketchStays > 0) {
      this.sketchStays -= 1;
      return true;
    }
    if (sketch === null || this.table.rows <= LARGE || this.pause.on) return null;
    if (sketch instanceof Promise) return false;
    this.sketch = null;
    sketch(step);
    this.sketchStays = SKETCH_FRAMES;
    return true;
  }

  /** Chooses details for a picture of so many pixels in height from where the sight is aimed; says whether some are left. */
  private refine(
    height: number,
    samples: number,
    quality: Quality,
    distance = this.camera.rig.view.distance,
    resting = this.loop.control.resting,
  ): boolean {
    const fineness = this.fineness(height, quality);
    this.eye.set(...fineness.eye, fineness.pixels);
    this.world.uniforms.uSamples!.value = samples;
    const taps = quality.detailed ? 3 : 1;
    this.world.uniforms.uShadowTaps!.value = this.world.shown.shadow ? taps : 0;
    this.world.environment.reach(distance);
    this.world.finer?.detail(fineness, this.camera.sight.camera, resting && this.world.grassy);
    return this.world.tree.detail(fineness, resting);
  }

  private fineness(height: number, { detailed, merging, leaves, sprigs, twigs }: Quality): Fineness {
    const { position } = this.camera.sight.camera;
    const eye = [position.x, position.y, position.z] as const;
    return { eye, pixels: pixelsPerInternode(height), detailed, merging, leaves, sprigs, twigs };
  }

  /** Takes over what changed in the table. */
  private sync(): void {
    this.camera.aimed();
    if (!this.world.tree.sync(this.fineness(this.screen.size.y, QUALITIES[0]))) return;
    this.world.changed();
    this.camera.rig.keep(this.world.reach());
  }

  private resize(): void {
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.camera.sight.width = width;
    this.camera.sight.height = height;
    const ratio = Math.min(globalThis.devicePixelRatio, this.cardless ? MAX_CARDLESS_RATIO : MAX_PIXEL_RATIO);
    this.screen.resize(width, height, ratio);
    if (this.world.sun.fit(Math.max(width, height) * ratio)) this.world.shadow.stale = true;
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
    this.world.restored();
    this.air?.restored();
    this.loop.restored();
    this.lossChanged(false);
  };
}
