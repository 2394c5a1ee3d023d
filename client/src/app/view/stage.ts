import { signal } from "@preact/signals";
import { RADIANS_PER_PIXEL } from "../../scene/camera/camera-rig";
import type { PictureSize } from "../../scene/camera/sight";
import type { View } from "../../scene/camera/view";
import type { DrawMode, Legend } from "../../scene/mode/draw-mode";
import { isUsual, type Shown, USUAL } from "../../scene/mode/shown";
import type { Air, AirStage } from "../../scene/motion/air";
import type { TreeTable } from "../../scene/table/tree-table";
import type { Vec3 } from "../../scene/vector";
import type { Viewport } from "../../scene/viewport";
import type { Appearance } from "../../wire/generated";
import type { Settings } from "../page/settings";
import { MAX_RADIUS } from "../tools/brush/brush-radius";
import { coveredHead } from "./covered-head";
import { GrowthFollower } from "./growth-follower";
import { Holds } from "./holds";
import { nearestBase, scaleAt } from "./places";

/** How long the brush stays visible after its radius changed. */
const RADIUS_SHOWN_FOR = 900;

export interface StageOptions {
  readonly table: TreeTable;
  readonly settings: Pick<Settings, "radius" | "followsGrowth">;
  /** Whether a tool shows its own preview; then the radius is not shown. */
  readonly busy: () => boolean;
  /** Whether something grows. */
  readonly growing: () => boolean;
  /** The radius asked for is wider than the picture. */
  readonly tooWide: () => void;
}

/** The picture of the tree as the tools and the interface use it; the view may not exist yet. */
export class Stage {
  /** The radius of the widest brush that stays in the picture. */
  readonly widest = signal(MAX_RADIUS);
  /** Whether the camera has moved back to show growth, and the user has not moved it since. */
  readonly widened = signal(false);
  /** Whether the first tree has been drawn, or none can be: what the picture does without may be loaded from then on. */
  readonly opened = signal(false);
  /** Whether the picture is drawn by the processor. */
  readonly cardless = signal(false);
  /** Whether the tree stands still in the wind, for somebody works at it where it grew. */
  readonly stilled = signal(false);
  #options: StageOptions;
  #table: TreeTable;
  #follower: GrowthFollower;
  #view: Viewport | null = null;
  #canvas: HTMLCanvasElement | null = null;
  #radiusTimer = 0;
  /** Whether no picture can be drawn here. */
  #dark = false;
  /** What a picture made later begins with. */
  #appearance: Appearance | null = null;
  #mode: DrawMode = "lit";
  #shown: Shown = USUAL;
  /** What it is to show once it is made. */
  #look: View | null = null;
  #holds = new Holds((held) => {
    this.#view?.hold(held);
    this.follow();
  });
  #stills = new Holds((stilled) => {
    this.stilled.value = stilled;
  });

  constructor(options: StageOptions) {
    this.#options = options;
    this.#table = options.table;
    this.#follower = new GrowthFollower({
      view: () => this.#view?.camera ?? null,
      box: () => (this.#table.rows > 0 ? this.#table.bounds() : null),
      growing: options.growing,
      held: () => this.#holds.held,
      enabled: () => options.settings.followsGrowth.peek(),
    });
  }

  /** The view itself, while there is one. */
  get view(): Viewport | null {
    return this.#view;
  }

  attach(view: Viewport, canvas: HTMLCanvasElement): void {
    this.#view = view;
    this.#canvas = canvas;
    this.cardless.value = view.cardless;
    if (this.#appearance) {
      view.setAppearance(this.#appearance);
    }
    view.show(this.#mode, this.#shown);
    view.hold(this.#holds.held);
    if (this.#table.rows > 0) {
      view.changed();
    }
    if (this.#look) {
      view.camera.look(this.#look);
      this.#look = null;
    }
  }

  detach(): void {
    clearTimeout(this.#radiusTimer);
    this.#view = null;
    this.#canvas = null;
  }

  /** Whether no picture can be drawn here, as was found out when one was tried. */
  get dark(): boolean {
    return this.#dark;
  }

  /** No picture can be drawn. */
  darken(): void {
    this.#dark = true;
    this.opened.value = true;
  }

  /** A finger is down or a lever held: the picture is not at rest until what this returns was called. */
  hold(): () => void {
    return this.#holds.take();
  }

  /** The tree stands where it grew, however the wind blows, until what this returns was called. */
  still(): () => void {
    return this.#stills.take();
  }

  /** Rows have changed; draw. */
  changed(): void {
    this.#view?.changed();
    this.follow();
  }

  /** Growth may have begun, gone on or ended, or a finger has lifted: the camera moves back where that is called for. */
  follow(): void {
    this.#follower.follow();
    this.moved();
  }

  /** Another session is opened: what it shows has not grown before the user's eyes. */
  forget(): void {
    this.#follower.forget();
  }

  /** The view has another place or size. */
  moved(): void {
    if (this.#view) {
      this.widest.value = Math.min(MAX_RADIUS, Math.floor(10 * this.#view.widest()) / 10);
      this.widened.value = this.#view.camera.isWidened;
    }
  }

  /** Goes back to what was shown before the camera moved back. */
  unwiden(): void {
    this.#view?.camera.unwiden();
    this.moved();
  }

  /** The brush's radius as it draws: what was chosen, if the picture has room for it. */
  get radius(): number {
    return Math.min(this.#options.settings.radius.value, this.widest.value);
  }

  setLeafSize(size: number): void {
    this.#view?.setLeafSize(size);
  }

  /** How the tree and its surroundings look. */
  setAppearance(appearance: Appearance): void {
    this.#appearance = appearance;
    this.#view?.setAppearance(appearance);
  }

  /** What is shown of the tree. */
  show(mode: DrawMode, shown: Shown): void {
    this.#mode = mode;
    this.#shown = isUsual(shown) ? USUAL : shown;
    this.#view?.show(mode, this.#shown);
  }

  /** What the draw mode's colours mean, as the tree is now. */
  legend(): Legend | null {
    return this.#view?.legend() ?? null;
  }

  fitTree(): void {
    this.#view?.camera.fitTree(0, coveredHead());
  }

  look(view: View): void {
    if (this.#view) {
      this.#view.camera.look(view);
    } else {
      this.#look = view;
    }
  }

  /** Turns the tree around the vertical, by radians: above 0 its front goes to the right. */
  turn(radians: number): void {
    this.#view?.camera.orbit(radians / RADIANS_PER_PIXEL, 0);
  }

  /** Turns the tree to its front. */
  face(): void {
    this.#view?.camera.face();
  }

  /** Whether the camera has come where it goes. */
  get arrived(): boolean {
    return this.#view?.camera.arrived ?? true;
  }

  /** How far the tree is turned, in radians from −π to π; 0 as a page opens. */
  get turned(): number {
    const [right] = this.screenAxes() ?? [[1, 0, 0]];
    return Math.atan2(right[2], right[0]);
  }

  /** Has something move the tree; null while there is no picture. */
  enliven(make: (stage: AirStage) => Air): Air | null {
    return this.#view?.enliven(make) ?? null;
  }

  hideBrush(): void {
    this.#view?.hideBrush();
  }

  /** The row of the branch nearest to a place, within a tolerance in pixels. */
  pickRow(x: number, y: number, tolerance: number): number | null {
    return this.#view?.pick(x, y, tolerance)?.row ?? null;
  }

  /** Sets the brush's radius, no wider than the picture, and shows it for a moment where it would draw. */
  setRadius(wanted: number): void {
    const radius = Math.min(wanted, this.widest.peek());
    this.#options.settings.radius.value = radius;
    if (wanted > radius) {
      this.#options.tooWide();
    }
    const [view, canvas] = [this.#view, this.#canvas];
    if (!view || !canvas || this.#options.busy()) {
      return;
    }
    const { clientWidth: width, clientHeight: height } = canvas;
    const base = nearestBase(this.#table, view, width / 2, height / 2);
    const place = view.pointOnPlane(width / 2, height / 2, base);
    if (place) {
      view.showBrush([place], radius);
      clearTimeout(this.#radiusTimer);
      this.#radiusTimer = window.setTimeout(() => {
        if (!this.#options.busy()) {
          view.hideBrush();
        }
      }, RADIUS_SHOWN_FOR);
    }
  }

  /** A tool shows itself now; the radius need not. */
  radiusSeen(): void {
    clearTimeout(this.#radiusTimer);
  }

  /** What turns points of the world into places on the canvas, as the camera stands now. */
  projector(): ((point: Vec3) => readonly [number, number] | null) | null {
    return this.#view?.projector() ?? null;
  }

  /** Where a row is drawn while no wind moves it. */
  placeOf(row: number): Vec3 | null {
    return row < this.#table.rows ? (this.#view?.placeOf(row) ?? null) : null;
  }

  /** Where a row is seen, in the wind as well: for what is drawn over it. */
  seenAt(row: number): Vec3 | null {
    return row < this.#table.rows ? (this.#view?.seenAt(row) ?? null) : null;
  }

  /** The screen's own directions in the world: right, up, and out of it towards the eye. */
  screenAxes(): readonly [right: Vec3, up: Vec3, out: Vec3] | null {
    const plane = this.#view?.drawingPlane([0, 0, 0]);
    if (!plane) {
      return null;
    }
    const { right: r, up: u } = plane;
    return [r, u, [r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]]];
  }

  /** The base of the plant nearest to the middle of the canvas, and which ways are right and up on the screen. */
  middle(): { readonly base: Vec3; readonly right: Vec3; readonly up: Vec3 } {
    const [view, canvas] = [this.#view, this.#canvas];
    if (!view || !canvas) {
      return { base: [0, 0, 0], right: [1, 0, 0], up: [0, 1, 0] };
    }
    const base = nearestBase(this.#table, view, canvas.clientWidth / 2, canvas.clientHeight / 2);
    const { right, up } = view.drawingPlane(base);
    return { base, right, up };
  }

  /** How many pixels an internode is long at a point. */
  scaleAt(point: Vec3): number {
    return this.#view ? scaleAt(this.#view, point) : 0;
  }

  /** Pixels of the view across and down; null where there is none. */
  pixels(): PictureSize | null {
    return this.#view?.pixels ?? null;
  }

  /** The view as a picture of so many pixels. */
  async picture(size: PictureSize, stop: AbortSignal, tell: (share: number) => void): Promise<Blob> {
    return await (this.#view?.picture(size, stop, tell) ?? Promise.reject(new Error("no-view")));
  }

  /** A picture of the tree as a data URL, or undefined where none can be made. */
  async thumbnail(size: number): Promise<string | undefined> {
    return await this.#view?.thumbnail(size, size);
  }
}
