import type { WebGLRenderer } from "three";
import { GUST_SEED } from "../../wire/generated";
import { type DrawnElsewhere, type Pick, type Projection, pickBranch } from "../camera/picking";
import type { DrawnObstacle } from "../obstacle-meshes";
import type { QualityControl } from "../rendering/quality";
import type { Vec3 } from "../vector";
import type { World } from "../world";
import { soundAir } from "./air-numbers";
import { type AirSettings, alongOf, blows, CALM, stirs, velocityOf } from "./air-settings";
import { Amount } from "./amount";
import { Answers } from "./answers";
import { type Blend, blendOf, blendOver } from "./blend";
import type { Hand } from "./hand";
import { Hands, pluckedAnew } from "./hands";
import { JointMaker, type JointOrder } from "./joint-maker";
import type { JointsMade } from "./joint-work";
import { loaded } from "./loads";
import { motionRows } from "./motion-rows";
import { MovedRows } from "./moved-rows";
import type { Moving } from "./moving";
import { Pace } from "./pace";
import { type PlaceOf, restingPlace, swayedPlace } from "./places";
import { pose, STAND } from "./pose";
import { Riding } from "./riding";
import type { SharedClock } from "./shared-clock";
import type { Sway } from "./sway";
import { SwayMaterials } from "./sway-materials";
import { LIVE_PERIOD, type Wind, windOf } from "./wind";
import { Winds } from "./winds";
import type { Scale } from "./wood";

/** Milliseconds without a change of rows after which joints are made anew. */
const SETTLED = 300;
/** Milliseconds after which shelter is found anew at the earliest, for another one takes its time to fade. */
const TURNED = 250;
/** Milliseconds in which what joints were made anew shows takes the place of what was shown. */
const MIXED = 500;
/** Milliseconds between two looks at how far the tree reaches, and rows that are looked at. */
const MEASURED = 1000;
const SAMPLES = 600;

/** What the wind blows in. */
export interface AirStage {
  readonly renderer: WebGLRenderer;
  readonly world: World;
  readonly control: QualityControl;
  /** Has a frame drawn. */
  readonly invalidate: () => void;
}

/** The wind in the picture: while it blows every frame stands as its time has it; while none does the picture is as without it. */
export class Air {
  private readonly materials: SwayMaterials;
  private readonly rows: MovedRows;
  private readonly maker: JointMaker;
  private readonly pace = new Pace();
  private readonly amount = new Amount();
  private readonly hands = new Hands();
  private readonly winds = new Winds();
  private wanted: AirSettings = CALM;
  private scale: Scale = { internodeLength: 0.1, leafSize: 1 };
  private leaves = 1;
  private moving: Moving | null = null;
  private riding: Riding | null = null;
  private exposure: Float64Array = new Float64Array(0);
  private readonly known = new WeakMap<AirSettings, Wind>();
  /** Whether no wind has blown yet, or what blew has died away. */
  private rested = true;
  private sway: Sway | null = null;
  private bends = new Float64Array(0);
  private stands = new Float64Array(0);
  /** What each joint gets of the wind now: less where a hand is. */
  private exposed = new Float64Array(0);
  /** How rows stand in the frame that is seen; joints may have been made anew since. */
  private shown: { readonly stands: Float64Array; readonly riding: Riding; readonly placeOf: PlaceOf } | null = null;
  /** What joints and shelter were made for: to be made anew when that is another. */
  private made = { joints: "", along: "", at: Number.NEGATIVE_INFINITY };
  /** The obstacles that shelter was found behind last. */
  private around: readonly DrawnObstacle[] | null = null;
  private seen = { epoch: 0, sequence: null as number | null, at: Number.NEGATIVE_INFINITY };
  /** What the wind is in the frame that is seen, and in the one that another comes over. */
  private blend: Blend | null = null;
  private before: Blend | null = null;
  private mixing = Number.NEGATIVE_INFINITY;
  private measured = Number.NEGATIVE_INFINITY;
  private margin: number;
  private held: number | null = null;
  private disposed = false;

  constructor(
    private readonly stage: AirStage,
    private readonly clock: SharedClock,
  ) {
    const { world, renderer } = stage;
    this.rows = new MovedRows(world.uniforms);
    this.materials = new SwayMaterials(renderer, [world.tree.group, world.tree.casters], this.rows.essential);
    this.maker = new JointMaker(this.receive);
    this.margin = world.sun.margin;
    document.addEventListener("visibilitychange", stage.invalidate);
  }

  /** Whether trees are drawn as the wind moves them. */
  get blowing(): boolean {
    return this.materials.swaying;
  }

  /** Whether anything may be seen elsewhere in the next frame. */
  get sways(): boolean {
    return this.blowing && !this.hands.holdsAll;
  }

  /**
   * How trees are to sway from now on; `leaves` is how much theirs flutter beside those of others, `told` when it was set, in
   * seconds of the time that all share, or null where the server has yet to say.
   */
  set(settings: AirSettings, scale: Scale, leaves: number, told: number | null): void {
    this.wanted = soundAir(settings);
    this.winds.set(this.wanted, told);
    this.scale = scale;
    this.leaves = leaves;
    this.stage.invalidate();
  }

  /** Has programs and joints made before a wind blows. */
  warm(scale: Scale): void {
    this.scale = scale;
    this.prepare(performance.now());
  }

  /** Holds everything where it is, or lets it go. */
  hold(held: boolean): void {
    if (held === (this.held !== null)) return;
    this.held = held ? this.clock.read().time : null;
    if (!held) this.mix();
    this.stage.invalidate();
  }

  /** A hand works at the tree, which comes to rest under it; or none does. */
  touch(hand: Hand | null): void {
    this.hands.touch(hand);
    this.stage.invalidate();
  }

  /** Branches at these rows have been bent and are let go. */
  release(rows: readonly number[]): void {
    this.hands.release(rows);
    this.stage.invalidate();
  }

  /** Branches are cut off at these rows. */
  cut(rows: readonly number[]): void {
    if (this.blowing) this.hands.cut(rows);
  }

  /** Where a row is seen, but for the shiver of twigs. */
  seenAt(row: number, drawn: DrawnElsewhere): Vec3 {
    const { table } = this.stage.world;
    return (this.blowing && this.shown ? this.shown : drawn).placeOf(table, row);
  }

  /** Whether it is too early for a frame that only the wind asks for. */
  early(began: number): boolean {
    return this.blowing && this.pace.early(began);
  }

  /** Has everything stand as it does in a frame that begins now; says whether it goes on. */
  step(began: number): boolean {
    const wanted = blows(this.wanted);
    // In a calm nobody asks the server for its time.
    const { time, jumped } = wanted || this.blowing ? this.clock.read() : { time: 0, jumped: false };
    const missed = wanted ? 1000 * this.winds.lateness(time) : 0;
    if (!wanted && !this.blowing) {
      this.amount.wait(false);
      return false;
    }
    if (document.hidden) return false;
    if (!this.prepare(began)) {
      this.amount.wait(wanted);
      return false;
    }
    // Beside what would become of it the tree stands as it grew.
    const amount = this.amount.at(began, wanted, this.stage.world.ghost.group.visible, missed);
    if (!wanted && amount === 0) {
      this.rest();
      return false;
    }
    if (this.rested) this.begin(this.wanted);
    const { moving, sway, stage, riding } = this;
    if (!moving || !sway || !riding) return false;
    if (jumped && this.held === null) this.mix(began);
    const at = this.held ?? time;
    this.tune(began, at);
    sway.forget(at);
    sway.bends(at, this.bends);
    this.exposed.set(this.exposure);
    const { table } = stage.world;
    const handled = this.hands.apply(began, at, { table, riding, moving, sway }, this.bends, this.exposed);
    for (let i = 0; i < this.bends.length; i += 1) this.bends[i]! *= amount;
    pose(moving.hinges, this.bends, this.stands);
    if (this.shown?.riding !== riding) {
      const { overlays } = stage.world.tree;
      this.shown = { stands: this.stands, riding, placeOf: swayedPlace(this.stands, riding, overlays) };
    }
    this.rows.stand(moving.hinges, this.stands, this.exposed);
    const share = Math.min(1, Math.max(0, (began - this.mixing) / MIXED));
    const smooth = share * share * (3 - 2 * share);
    this.blend = blendOver(this.before, blendOf(this.winds.shares(at), this.windIn, at), smooth);
    this.rows.draw(stage.renderer, {
      blend: this.blend,
      internodeLength: this.scale.internodeLength,
      time: at,
      amount,
      share: smooth,
      leaves: this.leaves,
    });
    this.materials.sway(true);
    stage.world.shadow.stale ||= this.pace.shadow(began);
    this.reach(began);
    const blown = amount > 0 && this.held === null && (stirs(this.wanted) || this.changing(at));
    const turns = this.around !== stage.world.obstacles.shown;
    const moves = blown || handled || turns || share < 1 || this.amount.changing || this.made.joints === "";
    if (moves && this.pace.heavy(began)) stage.control.moved(began);
    return moves;
  }

  /** The branch under or near a place on the canvas, as it is seen; its point is where that is at rest. */
  pick(view: Projection, x: number, y: number, tolerance: number, drawn: DrawnElsewhere | null): Pick | null {
    const { table } = this.stage.world;
    const { shown } = this;
    if (!this.blowing || !shown) return pickBranch(table, view, x, y, tolerance, drawn);
    const seen = drawn ? shown.placeOf : swayedPlace(shown.stands, shown.riding, null);
    const pick = pickBranch(table, view, x, y, tolerance, {
      placeOf: seen,
      hides: (row) => drawn?.hides(row) ?? false,
    });
    return pick && { row: pick.row, point: restingPlace(table, pick, seen, drawn), seen: pick.point };
  }

  /** What draws rows does so otherwise from now on. */
  redress(): void {
    this.materials.renew();
  }

  /** A restored context has lost every texture. */
  restored(): void {
    this.rows.restored();
  }

  dispose(): void {
    this.disposed = true;
    document.removeEventListener("visibilitychange", this.stage.invalidate);
    this.rest();
    this.maker.dispose();
    this.rows.dispose();
    this.materials.dispose();
  }

  /** Sees to joints for the rows that there are; says whether there is all that a frame takes. */
  private prepare(began: number): boolean {
    const { table } = this.stage.world;
    if (!this.materials.complete) {
      void this.materials.prepare().then(() => this.disposed || this.stage.invalidate());
    }
    if (table.rows === 0) {
      this.forget();
      return false;
    }
    if (this.seen.epoch !== table.epoch || this.seen.sequence !== table.sequence) this.follow(began);
    if (!this.maker.busy) this.order(began);
    return this.materials.ready && this.sway !== null;
  }

  /** Takes over what has changed in the table: new rows go on as those below them, until joints are made anew. */
  private follow(began: number): void {
    const { table } = this.stage.world;
    // What is opened is there at once; what grows is waited for.
    const opened = this.moving === null || this.seen.epoch !== table.epoch;
    const at = opened || this.hands.waits ? Number.NEGATIVE_INFINITY : began;
    if (opened) this.hands.forget();
    this.seen = { epoch: table.epoch, sequence: table.sequence, at };
    this.made.joints = "";
    const first = this.riding?.follow(table) ?? null;
    if (first !== null && this.riding) this.rows.ride(this.riding.rows, this.riding.count, first);
  }

  private order(began: number): void {
    const { table, obstacles } = this.stage.world;
    const { suppleness } = this.wanted;
    const { internodeLength, leafSize } = this.scale;
    const joints = `${internodeLength} ${leafSize} ${suppleness}`;
    const along = alongOf(this.wanted);
    const anew = joints !== this.made.joints;
    if (anew && began - this.seen.at < SETTLED) return;
    const turned = along.join(" ") !== this.made.along || obstacles.shown !== this.around;
    if (!anew && (!turned || began - this.made.at < TURNED)) return;
    this.made = { joints, along: along.join(" "), at: began };
    this.around = obstacles.shown;
    const grown = anew ? { rows: motionRows(table), scale: this.scale, suppleness } : null;
    this.maker.make({ grown, along, obstacles: obstacles.shown });
  }

  private readonly receive = ({ moving, exposure }: JointsMade, { grown }: JointOrder): void => {
    if (this.disposed) return;
    if (!moving) {
      // Whoever made the joints may be gone; all is made anew then.
      if (exposure.length === this.exposure.length) this.exposure = exposure;
      else this.made.joints = "";
      this.winds.shelter();
      this.stage.invalidate();
      return;
    }
    const { joints } = moving;
    const { moving: before, sway } = this;
    const { table } = this.stage.world;
    if (before) this.mix();
    this.moving = moving;
    this.exposure = exposure;
    this.riding = new Riding(moving, grown!.rows.parent, grown!.rows.quantised);
    this.bends = new Float64Array(3 * joints.count);
    this.stands = new Float64Array(STAND * joints.count);
    this.exposed = new Float64Array(joints.count);
    this.riding.follow(table);
    this.rows.ride(this.riding.rows, this.riding.count);
    this.hands.adopt(moving, before, { table, riding: this.riding }, grown!.rows.radiusCode);
    this.sway = this.winds.stand(this.wanted, this.answers);
    for (const pluck of before && sway ? pluckedAnew(sway.plucked, before.first, moving.first) : []) {
      this.sway.pluck(pluck);
    }
    this.stage.invalidate();
  };

  /** A wind, and what all joints answer it. */
  private readonly answers = (settings: AirSettings): Answers => {
    const sag = loaded(this.moving!.loads, settings);
    return new Answers(this.moving!.joints, this.windIn(settings), this.exposure, { damping: settings.damping, sag });
  };

  private readonly windIn = (settings: AirSettings): Wind => {
    const { turbulence } = settings;
    const wind =
      this.known.get(settings) ?? windOf({ velocity: velocityOf(settings), turbulence, seed: GUST_SEED }, LIVE_PERIOD);
    this.known.set(settings, wind);
    return wind;
  };

  /** A wind is there at once. */
  private begin(settings: AirSettings): void {
    this.rested = false;
    this.winds.begin(settings);
    this.sway = this.winds.stand(settings, this.answers);
  }

  /** Has other winds take over that were set. */
  private tune(began: number, time: number): void {
    if (this.held === null) {
      this.winds.pass(this.sway!, time, this.answers, () => this.mix(began));
      return;
    }
    const latest = this.winds.latest(time);
    if (!latest) return;
    this.mix(began);
    this.begin(latest);
  }

  /** Whether one wind still takes over from another. */
  private changing(time: number): boolean {
    return this.winds.waiting || (this.sway?.changing(time) ?? false);
  }

  /** What is shown now is held, and what comes then shows over it by and by. */
  private mix(began = performance.now()): void {
    if (!this.blowing) return;
    this.rows.remember();
    this.before = this.blend;
    this.mixing = began;
  }

  /** Keeps room for shadows of what the wind carries out of the tree's box. */
  private reach(began: number): void {
    if (began - this.measured < MEASURED || !this.riding) return;
    this.measured = began;
    const { table, sun } = this.stage.world;
    const seen = swayedPlace(this.stands, this.riding, null);
    let far = 0;
    for (let row = 0; row < table.rows; row += Math.ceil(table.rows / SAMPLES)) {
      const place = seen(table, row);
      far = Math.max(far, ...[0, 1, 2].map((a) => Math.abs(place[a]! - table.course.placed[3 * row + a]!)));
    }
    // By whole steps and never less, so that shadows do not swim.
    sun.margin = Math.max(sun.margin, this.margin + 4 * Math.ceil(far / 4));
  }

  /** The tree stands as it grew, and is drawn as if there were no wind. */
  private rest(): void {
    if (!this.blowing) return;
    this.rested = true;
    this.materials.sway(false);
    this.pace.rest();
    const { world } = this.stage;
    world.sun.margin = this.margin;
    world.shadow.stale = true;
  }

  /** There is no tree any more. */
  private forget(): void {
    this.rest();
    this.rested = true;
    this.moving = null;
    this.riding = null;
    this.shown = null;
    this.sway = null;
    this.hands.forget();
    this.made.joints = "";
  }
}
