import type { Vec3 } from "../vector";
import { type Box, type CameraView, FIELD_OF_VIEW } from "./camera-view";

/** The share of the picture that a box fills after the camera has moved back for it. */
const FILLED = 0.84;

/** Whether a view shows the whole box. */
export function frames(box: Box, view: CameraView, aspect: number): boolean {
  const up = Math.tan(FIELD_OF_VIEW / 2);
  return cornersSeen(box, view).every(([x, y, depth]) => {
    const away = depth + view.distance;
    return away > 0 && Math.abs(x) <= away * up * aspect && Math.abs(y) <= away * up;
  });
}

/** The view nearest to one that shows the whole box, in the same direction and no nearer. */
export function widened(box: Box, view: CameraView, aspect: number): CameraView {
  const up = FILLED * Math.tan(FIELD_OF_VIEW / 2);
  const corners = cornersSeen(box, view);
  const bounds = [
    { axis: 0, slope: up * aspect },
    { axis: 1, slope: up },
  ] as const;
  const needed = bounds.map(({ axis, slope }) => {
    const high = Math.max(...corners.map((corner) => corner[axis] - slope * corner[2]));
    const low = Math.min(...corners.map((corner) => corner[axis] + slope * corner[2]));
    return (high - low) / (2 * slope);
  });
  const distance = Math.max(view.distance, ...needed);
  const [aside, above] = bounds.map(({ axis, slope }) => {
    const least = Math.max(...corners.map((corner) => corner[axis] - slope * (corner[2] + distance)));
    const most = Math.min(...corners.map((corner) => corner[axis] + slope * (corner[2] + distance)));
    return Math.min(Math.max(0, least), most);
  }) as [number, number];
  const [right, top] = axesOf(view);
  const target = view.target.map((value, i) => value + aside * right[i]! + above * top[i]!) as [number, number, number];
  return { ...view, target, distance };
}

/** The screen's right and up, and straight ahead. */
function axesOf({ yaw, pitch }: CameraView): readonly [right: Vec3, up: Vec3, ahead: Vec3] {
  const [sy, cy, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  return [
    [cy, 0, -sy],
    [-sp * sy, cp, -sp * cy],
    [-cp * sy, -sp, -cp * cy],
  ];
}

/** A box's corners from the target: to the right, up, and further away. */
function cornersSeen({ min, max }: Box, view: CameraView): Vec3[] {
  const axes = axesOf(view);
  return Array.from({ length: 8 }, (_, corner) => {
    const from = [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? max : min)[axis]! - view.target[axis]!);
    return axes.map((axis) => axis[0] * from[0]! + axis[1] * from[1]! + axis[2] * from[2]!) as [number, number, number];
  });
}
