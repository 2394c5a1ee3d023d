/** x, y, z in internodes, Y up. */
export type Vec3 = readonly [number, number, number];

/** A half line; its direction has length 1. */
export interface Ray {
  origin: Vec3;
  direction: Vec3;
}
