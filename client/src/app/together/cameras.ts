import type { CameraView } from "../../scene/camera/camera-view";
import type { Vec3 } from "../../scene/vector";
import { BOUNDS, type Camera, DEEPEST, FARTHEST } from "../../wire/generated";

const DEGREES = 180 / Math.PI;

/** A camera as others are told of it, in thousandths, so that one at rest stays the same. */
export function told({ target, yaw, pitch, distance }: CameraView): Camera {
  const turn = (((yaw * DEGREES + 180) % 360) + 360) % 360;
  return {
    target: [
      rounded(within(target[0], -FARTHEST, FARTHEST)),
      rounded(within(target[1], DEEPEST, FARTHEST)),
      rounded(within(target[2], -FARTHEST, FARTHEST)),
    ],
    yaw: rounded(turn - 180),
    pitch: rounded(pitch * DEGREES),
    distance: rounded(within(distance, BOUNDS.EyeDistance.least, BOUNDS.EyeDistance.most)),
  };
}

/** A camera that others tell of, as this page has its own. */
export function seen({ target, yaw, pitch, distance }: Camera): CameraView {
  return { target: [...target], yaw: yaw / DEGREES, pitch: pitch / DEGREES, distance };
}

/** The same from the numbers of a frame. */
export function seenIn([x = 0, y = 0, z = 0, yaw = 0, pitch = 0, distance = 1]: readonly number[]): CameraView {
  return seen({ target: [x, y, z], yaw, pitch, distance });
}

/** A place that can be told of. */
export function place([x, y, z]: Vec3): [number, number, number] {
  return [
    rounded(within(x, -FARTHEST, FARTHEST)),
    rounded(within(y, DEEPEST, FARTHEST)),
    rounded(within(z, -FARTHEST, FARTHEST)),
  ];
}

export function within(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

function rounded(value: number): number {
  return Math.round(value * 1000) / 1000;
}
