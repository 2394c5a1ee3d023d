import type { Vec3 } from "../vector";
import { type Box, type CameraView, FIELD_OF_VIEW } from "./camera-view";
import { Damper } from "./damper";
import type { View } from "./view";
import { frames, widened } from "./widening";

const HALF_LIFE = 0.06;
const EASE_HALF_LIFE = 0.18;
/** Height in internodes that a new view shows. */
const FIRST_HEIGHT = 40;
/** Looking up a little: the crown then stands against the sky. */
const FIRST_PITCH = -0.08;
const MIN_DISTANCE = 2.5;
const MAX_PITCH = 1.5;
/** The eye stays this far above the ground. */
const EYE_CLEARANCE = 0.6;
/** How far the view turns with a finger. */
export const RADIANS_PER_PIXEL = 0.006;
const SMALLEST_FIT = 20;

/** An orbiting camera that follows its goal smoothly and never loses the tree or goes under the ground. */
export class CameraRig {
  /** What is shown now. */
  readonly view: CameraView;
  private readonly goal: CameraView;
  private box: Box = { min: [0, 0, 0], max: [0, 0, 0] };
  private readonly quick = dampers(HALF_LIFE);
  private readonly slow = dampers(EASE_HALF_LIFE);
  private easing = false;
  /** Where the goal was before the last `fit`, as long as the user has not moved the camera since. */
  private before: CameraView | null = null;
  /** What `fit` showed; it may be about to grow there, and stays in reach until the user moves the camera. */
  private fittedBox: Box | null = null;
  /** Where the goal was before `widen`, as long as the user has not moved the camera since. */
  private narrow: CameraView | null = null;
  /** How often the user has moved the camera. */
  moves = 0;

  constructor() {
    const distance = FIRST_HEIGHT / (2 * Math.tan(FIELD_OF_VIEW / 2));
    this.view = { target: [0, 0.42 * FIRST_HEIGHT, 0], yaw: 0, pitch: FIRST_PITCH, distance };
    this.goal = structuredClone(this.view);
  }

  /** Where the eye is. */
  eye(view: CameraView = this.view): Vec3 {
    const level = view.distance * Math.cos(view.pitch);
    return [
      view.target[0] + level * Math.sin(view.yaw),
      view.target[1] + view.distance * Math.sin(view.pitch),
      view.target[2] + level * Math.cos(view.yaw),
    ];
  }

  /** Sets the box that is kept in reach. */
  keep(box: Box): void {
    this.box = this.fittedBox ? union(box, this.fittedBox) : box;
    this.limit();
  }

  orbit(dx: number, dy: number): void {
    this.take();
    this.goal.yaw -= dx * RADIANS_PER_PIXEL;
    this.goal.pitch += dy * RADIANS_PER_PIXEL;
    this.limit();
  }

  /** Turns to the front, the shorter way round, wherever the view is on its way to. */
  face(): void {
    this.take();
    this.goal.yaw = 2 * Math.PI * Math.round(this.goal.yaw / (2 * Math.PI));
    this.limit();
  }

  /** Moves the picture by pixels, at the target's depth. */
  pan(dx: number, dy: number, height: number): void {
    this.take();
    const scale = (2 * this.goal.distance * Math.tan(FIELD_OF_VIEW / 2)) / height;
    const { yaw, pitch, target } = this.goal;
    target[0] += (-dx * Math.cos(yaw) - dy * Math.sin(pitch) * Math.sin(yaw)) * scale;
    target[1] += dy * Math.cos(pitch) * scale;
    target[2] += (dx * Math.sin(yaw) - dy * Math.sin(pitch) * Math.cos(yaw)) * scale;
    this.limit();
  }

  /** Brings what is seen at `right`, `up` from the middle, in halves of the picture's height, nearer or further. */
  zoom(factor: number, right: number, up: number): void {
    this.take();
    const before = this.goal.distance;
    this.goal.distance = Math.min(Math.max(before / factor, MIN_DISTANCE), this.furthest());
    const shift = (before - this.goal.distance) * Math.tan(FIELD_OF_VIEW / 2);
    const { yaw, pitch, target } = this.goal;
    target[0] += shift * (right * Math.cos(yaw) - up * Math.sin(pitch) * Math.sin(yaw));
    target[1] += shift * up * Math.cos(pitch);
    target[2] += shift * (-right * Math.sin(yaw) - up * Math.sin(pitch) * Math.cos(yaw));
    this.limit();
  }

  /**
   * Eases to a view of the whole box; `covered` and `head` are the shares of the picture at its foot and at its upper edge
   * that something lies over.
   */
  fit(box: Box, aspect: number, covered = 0, head = 0): void {
    this.moves += 1;
    this.narrow = null;
    this.before = structuredClone(this.goal);
    this.fittedBox = box;
    this.box = union(this.box, box);
    const view = fitted(box, aspect, this.goal.yaw);
    view.distance /= 1 - covered;
    view.target[1] -= covered * view.distance * Math.tan(FIELD_OF_VIEW / 2);
    lower(view, box, head);
    Object.assign(this.goal, view);
    this.easing = true;
    this.limit();
  }

  /** Whether the whole box is in the picture, once the camera has come where it goes. */
  frames(box: Box, aspect: number): boolean {
    return frames(box, this.goal, aspect);
  }

  /** Eases back until the whole box is in the picture. */
  widen(box: Box, aspect: number): void {
    this.narrow ??= structuredClone(this.goal);
    this.box = union(this.box, box);
    Object.assign(this.goal, widened(box, this.goal, aspect));
    this.easing = true;
    this.limit();
  }

  get isWidened(): boolean {
    return this.narrow !== null;
  }

  /** Eases to where the camera was before `widen`, unless the user has moved it since. */
  unwiden(): void {
    if (!this.narrow) return;
    Object.assign(this.goal, this.narrow);
    this.take();
    this.easing = true;
    this.limit();
  }

  /** Shows the box at once, as is wanted. */
  look(box: Box, aspect: number, wanted: View): void {
    this.take();
    this.box = union(this.box, box);
    const view = fitted(box, aspect, (wanted.yaw * Math.PI) / 180);
    view.pitch = (wanted.pitch * Math.PI) / 180;
    view.distance /= wanted.zoom;
    const half = view.distance * Math.tan(FIELD_OF_VIEW / 2);
    view.target[0] -= wanted.right * half * Math.cos(view.yaw);
    view.target[1] -= wanted.up * half;
    view.target[2] += wanted.right * half * Math.sin(view.yaw);
    Object.assign(this.goal, view);
    this.limit();
    Object.assign(this.view, structuredClone(this.goal));
  }

  /** Goes along with another camera; that is no move of the user's. */
  accompany(view: CameraView): void {
    const turns = Math.round((this.goal.yaw - view.yaw) / (2 * Math.PI));
    Object.assign(this.goal, view, { target: [...view.target], yaw: view.yaw + 2 * Math.PI * turns });
    this.narrow = null;
    this.easing = false;
    this.limit();
  }

  /** Eases to where another camera is; `restore` leads back. */
  visit(view: CameraView): void {
    this.moves += 1;
    this.before = structuredClone(this.goal);
    this.fittedBox = null;
    this.accompany(view);
    this.easing = true;
  }

  /** Eases back to where the camera was before the last `fit`, unless the user has moved it since. */
  restore(): void {
    if (!this.before) return;
    Object.assign(this.goal, this.before);
    this.before = null;
    this.fittedBox = null;
    this.easing = true;
    this.limit();
  }

  /** Moves on by `seconds`; false once the goal is reached. */
  step(seconds: number): boolean {
    const by = this.easing ? this.slow : this.quick;
    const { view, goal } = this;
    const range = goal.distance;
    for (const axis of [0, 1, 2] as const) {
      view.target[axis] = by.target[axis].step(view.target[axis], goal.target[axis], seconds, range);
    }
    view.yaw = by.yaw.step(view.yaw, goal.yaw, seconds, 1);
    view.pitch = by.pitch.step(view.pitch, goal.pitch, seconds, 1);
    view.distance = by.distance.step(view.distance, goal.distance, seconds, range);
    // Each part of the way lies above the ground only if their sum is looked at.
    view.pitch = Math.max(view.pitch, lowestPitch(view));
    if (this.arrived) this.easing = false;
    return !this.arrived;
  }

  /** Whether the view is the goal. */
  get arrived(): boolean {
    const { view, goal } = this;
    return (
      view.yaw === goal.yaw &&
      view.pitch === goal.pitch &&
      view.distance === goal.distance &&
      view.target.every((value, axis) => value === goal.target[axis])
    );
  }

  /** The user takes hold of the camera. */
  private take(): void {
    this.moves += 1;
    this.narrow = null;
    this.easing = false;
    this.before = null;
    this.fittedBox = null;
  }

  private furthest(): number {
    return Math.max(140, 5 * size(this.box));
  }

  private limit(): void {
    const { goal, box } = this;
    const reach = 10 + 0.5 * size(box);
    for (const axis of [0, 1, 2] as const) {
      const low = axis === 1 ? 0 : box.min[axis] - reach;
      goal.target[axis] = Math.min(Math.max(goal.target[axis], low), box.max[axis] + reach);
    }
    goal.distance = Math.min(Math.max(goal.distance, MIN_DISTANCE), this.furthest());
    goal.pitch = Math.min(Math.max(goal.pitch, lowestPitch(goal)), MAX_PITCH);
  }
}

/** A view that shows the whole box with some room around it. */
export function fitted(box: Box, aspect: number, yaw: number): CameraView {
  const height = Math.max(SMALLEST_FIT, box.max[1] - Math.min(0, box.min[1]));
  const width = Math.max(SMALLEST_FIT, box.max[0] - box.min[0], box.max[2] - box.min[2]);
  const half = Math.tan(FIELD_OF_VIEW / 2);
  const distance = Math.max((0.6 * height) / half, (0.57 * width) / (half * aspect)) + 0.3 * width;
  return {
    target: [(box.min[0] + box.max[0]) / 2, 0.46 * height, (box.min[2] + box.max[2]) / 2],
    yaw,
    pitch: FIRST_PITCH,
    distance,
  };
}

/** Takes a view that shows a box as far back as it takes for nothing of it to reach into a share of the picture at its head. */
function lower(view: CameraView, box: Box, head: number): void {
  const half = Math.tan(FIELD_OF_VIEW / 2);
  const most = 1 - 2 * head;
  if (box.max[1] - view.target[1] <= most * half * view.distance) return;
  // Its foot stays where it is in the picture.
  const foot = Math.min(0, box.min[1]);
  const below = (view.target[1] - foot) / (half * view.distance);
  view.distance = (box.max[1] - foot) / ((most + below) * half);
  view.target[1] = foot + below * half * view.distance;
}

/** The box around two boxes. */
export function union(a: Box, b: Box): Box {
  const axes = [0, 1, 2] as const;
  return {
    min: axes.map((axis) => Math.min(a.min[axis], b.min[axis])) as [number, number, number],
    max: axes.map((axis) => Math.max(a.max[axis], b.max[axis])) as [number, number, number],
  };
}

/** How far the eye may sink before it touches the ground. */
function lowestPitch(view: CameraView): number {
  return Math.asin(Math.min(1, Math.max(-1, (EYE_CLEARANCE - view.target[1]) / view.distance)));
}

function size(box: Box): number {
  return Math.hypot(box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]);
}

function dampers(halfLife: number) {
  const one = () => new Damper(halfLife);
  return { target: [one(), one(), one()] as const, yaw: one(), pitch: one(), distance: one() };
}
