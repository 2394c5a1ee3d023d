import type { Vec3 } from "../../../scene/vector";
import type { Grip } from "../../input/gesture-recogniser";
import type { Key } from "../../words/say";
import { type GripTool, PICK_TOLERANCE } from "../tool";
import { about, after, Ball, cross, dot, minus, type Rotation, type ScreenAxes, UNTURNED } from "./branch-turn";
import type { HeldBranch } from "./held-branch";

/** How near to the branch's base a finger takes hold of its ring, in pixels. */
export const RING = 46;
/** The ball that turns a branch is at least so large, in pixels. */
const LEAST_BALL = 40;
/** A finger so far from where it met a limb says which way the branch shall point, in pixels. */
const AIMS_FROM = 36;

/** What carrying branches needs of the view. */
export interface BranchView {
  pick(x: number, y: number, tolerance: number): { readonly row: number; readonly point: Vec3 } | null;
  /** Where the ray through a pixel meets the plane parallel to the screen through a point. */
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  /** That plane, with the screen's own directions. */
  drawingPlane(through: Vec3): ScreenAxes;
  projector(): (point: Vec3) => readonly [number, number] | null;
}

export interface BranchToolOptions {
  readonly view: BranchView;
  readonly branch: HeldBranch;
  /** Something a person should know. */
  readonly say: (text: Key) => void;
}

interface Spot {
  readonly x: number;
  readonly y: number;
}

interface Finger {
  readonly id: number;
  readonly slop: number;
  readonly begun: Spot;
  now: Spot;
  moved: boolean;
}

type Hold =
  /** On the branch or its ring. */
  | {
      readonly kind: "turn";
      readonly finger: Finger;
      /** A second finger, which twists. */
      second: Finger | null;
      readonly picked: number | null;
      /** Whether the branch was held before the finger came. */
      readonly held: boolean;
      readonly ball: Ball;
      readonly base: Vec3;
      readonly axes: ScreenAxes;
      rolled: Rotation;
      /** Radians about the branch's own axis. */
      twist: number;
    }
  /** Looking for a limb that shall bear the branch. */
  | { readonly kind: "place"; readonly finger: Finger; readonly search: Search }
  /** On nothing. */
  | { readonly kind: "nothing"; readonly finger: Finger };

type Turn = Extract<Hold, { kind: "turn" }>;

interface Search {
  /** Where the finger met the limb. */
  met: (Spot & { readonly onto: number }) | null;
  aiming: boolean;
}

/** Takes hold of a branch, turns it about its base, and sets it on other limbs. */
export class BranchTool implements GripTool {
  #options: BranchToolOptions;
  #hold: Hold | null = null;

  constructor(options: BranchToolOptions) {
    this.#options = options;
  }

  takes(): Grip {
    const hold = this.#hold;
    if (hold === null) {
      return "take";
    }
    if (hold.kind !== "turn") {
      return "leave";
    }
    return hold.second === null ? "take" : "ignore";
  }

  gripBegin(id: number, x: number, y: number, slop: number): void {
    const { view, branch } = this.#options;
    const finger = { id, slop, begun: { x, y }, now: { x, y }, moved: false };
    if (this.#hold?.kind === "turn") {
      this.#hold.second = finger;
      this.#lift(this.#hold);
      return;
    }
    if (branch.placing.peek() !== null) {
      this.#hold = { kind: "place", finger, search: { met: null, aiming: false } };
      this.#search(this.#hold.search, finger.now);
      return;
    }
    const picked = view.pick(x, y, PICK_TOLERANCE);
    const held = this.#onRing(finger.now) || (picked !== null && branch.holds(picked.row));
    if (!held && picked && !branch.take(picked.row)) {
      this.#options.say("tools.trunk-held");
      this.#hold = { kind: "nothing", finger: { ...finger, moved: true } };
      return;
    }
    const base = branch.base();
    if ((!held && !picked) || !base) {
      this.#hold = { kind: "nothing", finger };
      return;
    }
    // A ring that is gripped beside the branch is gripped in the plane it lies in.
    const on = picked && branch.holds(picked.row) ? picked.point : base;
    const axes = view.drawingPlane(base);
    this.#hold = {
      kind: "turn",
      finger,
      second: null,
      picked: picked?.row ?? null,
      held,
      ball: this.#ball(finger.now, base, on, axes),
      base,
      axes,
      rolled: UNTURNED,
      twist: 0,
    };
  }

  gripMove(id: number, x: number, y: number): void {
    const hold = this.#hold;
    if (hold?.kind === "turn" && hold.second?.id === id) {
      this.#twistTo(hold, hold.second, { x, y });
      return;
    }
    if (hold?.finger.id !== id) {
      return;
    }
    const { finger } = hold;
    const before = finger.now;
    finger.now = { x, y };
    finger.moved ||= Math.hypot(x - finger.begun.x, y - finger.begun.y) > finger.slop;
    if (hold.kind === "place") {
      this.#search(hold.search, finger.now);
    } else if (hold.kind === "turn" && finger.moved) {
      this.#lift(hold);
      const place = this.#options.view.pointOnPlane(x, y, hold.base);
      if (place) {
        const away = minus(place, hold.base);
        hold.rolled = hold.ball.to(dot(away, hold.axes.right), dot(away, hold.axes.up));
      }
      if (hold.second) {
        hold.twist += this.#between(before, hold.second.now, finger.now, hold.second.now);
      }
      this.#show(hold);
    }
  }

  gripEnd(id: number): void {
    const hold = this.#hold;
    if (hold?.kind === "turn" && hold.second?.id === id) {
      hold.second = null;
    } else if (hold?.finger.id === id) {
      this.end();
    }
  }

  gripDrop(): void {
    const turned = this.#hold?.kind === "turn";
    this.#hold = null;
    if (turned) {
      this.#options.branch.cancelTurn();
    } else {
      this.#options.branch.hide();
    }
  }

  /** While a finger is down, the wheel turns the branch about its own axis, and does not zoom. */
  zoom(factor: number): boolean {
    this.twist(2 * Math.log(factor));
    return true;
  }

  /** Turns the branch about its own axis by so many radians, as the wheel does; false if none is held. */
  twist(radians: number): boolean {
    const hold = this.#hold;
    if (hold?.kind !== "turn") {
      return false;
    }
    this.#lift(hold);
    hold.twist += radians;
    this.#show(hold);
    return true;
  }

  end(): void {
    const hold = this.#hold;
    const { branch, say } = this.#options;
    this.#hold = null;
    if (hold?.kind === "place") {
      if (!branch.graft()) {
        branch.hide();
        say("tools.no-limb");
      }
    } else if (hold?.kind === "turn" && branch.turning.peek()) {
      branch.endTurn();
    } else if (hold?.kind === "turn" && hold.held && hold.picked !== null) {
      branch.take(hold.picked);
    } else if (hold?.kind === "nothing" && !hold.finger.moved) {
      branch.release();
    }
  }

  abandon(): void {
    this.#hold = null;
    this.#options.branch.cancelTurn();
    this.#options.branch.cancelPlacing();
  }

  hover(x: number, y: number): void {
    if (this.#options.branch.placing.peek() !== null && this.#hold === null) {
      this.#search({ met: null, aiming: false }, { x, y });
    }
  }

  leave(): void {
    if (this.#hold === null) {
      this.#options.branch.hide();
    }
  }

  release(): boolean {
    const { branch } = this.#options;
    if (branch.placing.peek() !== null) {
      branch.cancelPlacing();
      return true;
    }
    const held = branch.row.peek() !== null;
    branch.release();
    return held;
  }

  #ball(at: Spot, base: Vec3, on: Vec3, axes: ScreenAxes): Ball {
    const { view } = this.#options;
    const out = cross(axes.right, axes.up);
    const flat = minus(view.pointOnPlane(at.x, at.y, base) ?? base, base);
    const [right, up, depth] = [dot(flat, axes.right), dot(flat, axes.up), dot(minus(on, base), out)];
    const along = (i: 0 | 1 | 2) => right * axes.right[i] + up * axes.up[i] + depth * out[i];
    return new Ball([along(0), along(1), along(2)], LEAST_BALL * this.#pixel(base), axes);
  }

  /** The branch begins to turn, if it has not yet. */
  #lift({ finger }: Turn): void {
    finger.moved = true;
    if (!this.#options.branch.turning.peek()) {
      this.#options.branch.beginTurn();
    }
  }

  #twistTo(hold: Turn, second: Finger, to: Spot): void {
    hold.twist += this.#between(hold.finger.now, second.now, hold.finger.now, to);
    second.now = to;
    this.#show(hold);
  }

  /** How far the way from one finger to another has turned, as the branch sees it from its base, in radians. */
  #between(a: Spot, b: Spot, c: Spot, d: Spot): number {
    const turn = Math.atan2(b.y - a.y, b.x - a.x) - Math.atan2(d.y - c.y, d.x - c.x);
    const near = Math.atan2(Math.sin(turn), Math.cos(turn));
    const { branch, view } = this.#options;
    const { right, up } = view.drawingPlane(branch.base() ?? [0, 0, 0]);
    // A branch that points away from the eye is seen from below: there, turning it the same way looks opposite.
    return dot(branch.heading(), cross(right, up)) < 0 ? -near : near;
  }

  #show({ rolled, twist }: Turn): void {
    const { branch } = this.#options;
    branch.turn(after(rolled, about(branch.heading(), twist)));
  }

  /** Finds the limb under the finger; away from it, which way the branch shall point. */
  #search(search: Search, { x, y }: Spot): void {
    const { view, branch } = this.#options;
    const { met } = search;
    search.aiming ||= met !== null && Math.hypot(x - met.x, y - met.y) > AIMS_FROM;
    if (!search.aiming) {
      const picked = view.pick(x, y, PICK_TOLERANCE);
      if (picked && branch.mayBear(picked.row)) {
        search.met = { x: met?.x ?? x, y: met?.y ?? y, onto: picked.row };
      }
    }
    const base = branch.base();
    const place = base && view.pointOnPlane(x, y, base);
    if (search.met) {
      branch.showOn(search.met.onto, search.aiming ? place : null);
    } else if (place) {
      branch.showAt(place);
    }
  }

  #onRing({ x, y }: Spot): boolean {
    const base = this.#options.branch.base();
    const place = base && this.#options.view.projector()(base);
    return place != null && Math.hypot(x - place[0], y - place[1]) < RING;
  }

  /** How long a pixel is at a point, in internodes. */
  #pixel(point: Vec3): number {
    const { view } = this.#options;
    const [a, b] = [view.pointOnPlane(0, 0, point), view.pointOnPlane(100, 0, point)];
    return a && b ? Math.hypot(...minus(b, a)) / 100 : 0.05;
  }
}
