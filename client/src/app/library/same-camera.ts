import type { Shape } from "./version-shape";
import { versionPath } from "./version-shape";

/** Pictures around a tree, and pixels along the sides of each. */
export const STOPS = 12;
const SIDE = 480;
/** Degrees from the upper edge of a picture to the lower, and by which the eye looks down. */
const FOV = 26;
const RISE = 6;
/** Room around what is seen. */
const ROOM = 1.1;

/** The query of a picture in which all of these shapes are whole, from one of the stops: the same for each of them. */
export function sameCamera(shapes: readonly Shape[], stop: number): URLSearchParams {
  const least = (axis: 0 | 1 | 2) => Math.min(...shapes.map(({ min }) => min[axis]), axis === 1 ? 0 : Infinity);
  const most = (axis: 0 | 1 | 2) => Math.max(...shapes.map(({ max }) => max[axis]));
  const middle = ([0, 1, 2] as const).map((axis) => (least(axis) + most(axis)) / 2);
  const [x, y, z] = ([0, 1, 2] as const).map((axis) => (most(axis) - least(axis)) / 2) as [number, number, number];
  const around = Math.hypot(x, z);
  const half = Math.max(y * Math.cos((RISE * Math.PI) / 180) + around * Math.sin((RISE * Math.PI) / 180), around, 0.05);
  const distance = around + (ROOM * half) / Math.tan((0.5 * FOV * Math.PI) / 180);
  const text = (value: number) => String(Number(value.toFixed(3)));
  return new URLSearchParams({
    size: `${SIDE}x${SIDE}`,
    turn: text((360 / STOPS) * stop > 180 ? (360 / STOPS) * stop - 360 : (360 / STOPS) * stop),
    rise: text(RISE),
    fov: text(FOV),
    distance: text(distance),
    target: middle.map(text).join(","),
  });
}

/** Where the picture of a version from there is. */
export function pictureOfVersion(tree: string, number: number, camera: URLSearchParams): string {
  return `${versionPath(tree, number)}/tree.png?${camera}`;
}
