import type { Vec3 } from "../../../scene/vector";
import { DEEPEST, FARTHEST, type Pose } from "../../../wire/generated";
import type { StrokePoint } from "../../input/gesture-recogniser";
import { type Tool, tidy } from "../tool";

/** Nearer to the ground than this, in internodes, a thing is put down on it. */
const SETTLES_WITHIN = 0.7;

/** What moving things needs of the view. */
export interface ObstacleView {
  /** Where the ray through a pixel meets the plane parallel to the screen through a point. */
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  /** Where it meets the horizontal plane through a point. */
  pointOnLevel(x: number, y: number, through: Vec3): Vec3 | null;
  /** Whether the view is so much from above that things slide over the ground rather than rise from it. */
  looksDown(): boolean;
  /** The obstacle under a pixel, and where on it. */
  pickObstacle(x: number, y: number): { readonly id: number; readonly point: Vec3 } | null;
  /** How far an obstacle reaches below its own origin as it is turned; null where it has no lowest point. */
  depthBelow(id: number): number | null;
}

export interface ObstacleToolOptions {
  readonly view: ObstacleView;
  readonly poseOf: (id: number) => Pose | null;
  readonly choose: (id: number) => void;
  /** Puts an obstacle elsewhere. */
  readonly move: (id: number, pose: Pose) => void;
  /** Shows one where the finger holds it; null once it is let go. */
  readonly preview: (moved: { readonly id: number; readonly pose: Pose } | null) => void;
}

interface Grip {
  readonly id: number;
  readonly at: Vec3;
  readonly pose: Pose;
  readonly level: boolean;
  moved: Pose | null;
}

/** Moves an obstacle with a finger: from the side up, down and across, from above over the ground. */
export class ObstacleTool implements Tool {
  #options: ObstacleToolOptions;
  #grip: Grip | null = null;

  constructor(options: ObstacleToolOptions) {
    this.#options = options;
  }

  /** Whether a stroke that begins here would move something. */
  grips({ x, y }: StrokePoint): boolean {
    return this.#options.view.pickObstacle(x, y) !== null;
  }

  begin({ x, y }: StrokePoint): void {
    const { view, poseOf, choose } = this.#options;
    const picked = view.pickObstacle(x, y);
    const pose = picked && poseOf(picked.id);
    if (!picked || !pose) {
      return;
    }
    choose(picked.id);
    this.#grip = { id: picked.id, at: picked.point, pose, level: view.looksDown(), moved: null };
  }

  move(points: readonly StrokePoint[]): void {
    const grip = this.#grip;
    const last = points[points.length - 1];
    if (!grip || !last) {
      return;
    }
    const { view, preview } = this.#options;
    const { x, y } = last;
    const place = grip.level ? view.pointOnLevel(x, y, grip.at) : view.pointOnPlane(x, y, grip.at);
    if (place) {
      grip.moved = { ...grip.pose, position: this.#settled(grip, place) };
      preview({ id: grip.id, pose: grip.moved });
    }
  }

  end(): void {
    const grip = this.#grip;
    this.#grip = null;
    if (grip?.moved) {
      this.#options.move(grip.id, grip.moved);
    }
    this.#options.preview(null);
  }

  abandon(): void {
    this.#grip = null;
    this.#options.preview(null);
  }

  #settled({ id, at, pose }: Grip, place: Vec3): [number, number, number] {
    const clamp = (value: number, least: number) => tidy(Math.min(FARTHEST, Math.max(least, value)));
    const to = ([0, 1, 2] as const).map((axis) => pose.position[axis] + place[axis] - at[axis]);
    const [x = 0, y = 0, z = 0] = to;
    const below = this.#options.view.depthBelow(id);
    const stands = below !== null && Math.abs(y - below) < SETTLES_WITHIN;
    return [clamp(x, -FARTHEST), clamp(stands ? below : y, DEEPEST), clamp(z, -FARTHEST)];
  }
}
