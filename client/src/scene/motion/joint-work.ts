import type { Vec3 } from "../vector";
import { exposureOf } from "./exposure";
import { type Grown, jointsOf } from "./joints";
import type { MotionRows } from "./limbs";
import { loadsOf } from "./loads";
import { type Moving, movingOf } from "./moving";
import { ObstaclesReceived, type PostedObstacles } from "./obstacle-post";
import { sharesOf } from "./shelter";
import type { Scale } from "./wood";

/** What is asked of whoever makes joints. */
export interface JointTask {
  /** Rows that joints are made from; null for those of before. */
  readonly grown: { readonly rows: MotionRows; readonly scale: Scale; readonly suppleness: number } | null;
  /** Where the wind blows, as a unit vector. */
  readonly along: Vec3;
  /** What stands in it. */
  readonly obstacles: PostedObstacles;
}

/** The answer to it. */
export interface JointsMade {
  /** Null where they are those of before. */
  readonly moving: Moving | null;
  /** For each joint its wind as a share of the open wind's speed. */
  readonly exposure: Float64Array;
}

/** Makes joints, and remembers them for the next direction of the wind and for obstacles that move. */
export class JointWork {
  private grown: Grown | null = null;
  private unit = 1;
  private readonly obstacles = new ObstaclesReceived();

  make({ grown: rows, along, obstacles }: JointTask): JointsMade {
    let moving: Moving | null = null;
    if (rows) {
      this.unit = rows.scale.internodeLength;
      this.grown = jointsOf(rows.rows, rows.scale, rows.suppleness);
      moving = movingOf(this.grown, loadsOf(this.grown, rows.rows, rows.scale), this.unit);
    }
    const solids = this.obstacles.receive(obstacles, this.unit);
    if (!this.grown) return { moving: null, exposure: new Float64Array(0) };
    const { wood, joints } = this.grown;
    return { moving, exposure: exposureOf(joints, wood, sharesOf(wood, along, solids)) };
  }
}
