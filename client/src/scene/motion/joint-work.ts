import type { Vec3 } from "../vector";
import { behindCrowns, exposureOf } from "./exposure";
import { type Grown, jointsOf } from "./joints";
import type { MotionRows } from "./limbs";
import { loadsOf } from "./loads";
import { type Moving, movingOf } from "./moving";
import type { Scale } from "./wood";

/** What is asked of whoever makes joints. */
export interface JointOrder {
  /** Rows that joints are made from; null for those of before. */
  readonly grown: { readonly rows: MotionRows; readonly scale: Scale; readonly suppleness: number } | null;
  /** Where the wind blows, as a unit vector. */
  readonly along: Vec3;
}

/** The answer to it. */
export interface JointsMade {
  /** Null where they are those of before. */
  readonly moving: Moving | null;
  /** For each joint its wind as a share of the open wind's speed. */
  readonly exposure: Float64Array;
}

/** Makes joints, and remembers them for the next direction of the wind. */
export class JointWork {
  private grown: Grown | null = null;

  make({ grown: rows, along }: JointOrder): JointsMade {
    let moving: Moving | null = null;
    if (rows) {
      const { internodeLength } = rows.scale;
      this.grown = jointsOf(rows.rows, rows.scale, rows.suppleness);
      moving = movingOf(this.grown, loadsOf(this.grown, rows.rows, rows.scale), internodeLength);
    }
    if (!this.grown) return { moving: null, exposure: new Float64Array(0) };
    const { wood, joints } = this.grown;
    return { moving, exposure: exposureOf(joints, wood, behindCrowns(wood, along)) };
  }
}
