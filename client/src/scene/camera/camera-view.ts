/** Where the camera is: on a sphere around a target, looking at it. */
export interface CameraView {
  target: [number, number, number];
  /** Turn around the vertical, in radians; 0 looks along −z. */
  yaw: number;
  /** Height above the horizontal through the target, in radians. */
  pitch: number;
  /** From the target, in internodes. */
  distance: number;
}

/** A box in the world, along its axes. */
export interface Box {
  min: readonly [number, number, number];
  max: readonly [number, number, number];
}

/** Full vertical opening angle, in radians. */
export const FIELD_OF_VIEW = (32 * Math.PI) / 180;
