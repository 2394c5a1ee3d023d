import type { Vec3 } from "../../../scene/vector";
import { LOOKS } from "../../../wire/generated-tables";

/** Where the sun stands, in degrees: from the z axis towards the x axis, and above the horizon. */
export interface SunPlace {
  readonly azimuth: number;
  readonly elevation: number;
}

/** Where it is shown on a dome around the tree: to the right and up in dome radii, and before the tree or behind it. */
export interface DomePlace {
  readonly right: number;
  readonly up: number;
  readonly before: boolean;
}

/** The screen's own directions in the world: right, up, and out of it towards the eye. */
export type ScreenAxes = readonly [right: Vec3, up: Vec3, out: Vec3];

export const { least: LOWEST_SUN, most: HIGHEST_SUN } = LOOKS.background.sun_elevation;

const DEGREE = Math.PI / 180;

/** Where the sun is shown. */
export function shownAt({ azimuth, elevation }: SunPlace, [right, up, out]: ScreenAxes): DomePlace {
  const level = Math.cos(elevation * DEGREE);
  const towards: Vec3 = [
    level * Math.sin(azimuth * DEGREE),
    Math.sin(elevation * DEGREE),
    level * Math.cos(azimuth * DEGREE),
  ];
  return { right: dot(towards, right), up: dot(towards, up), before: dot(towards, out) >= 0 };
}

/** Where the sun stands when it is shown somewhere; beyond the dome's rim it stands on the rim. */
export function standingAt({ right: x, up: y, before }: DomePlace, [right, up, out]: ScreenAxes): SunPlace {
  const length = Math.hypot(x, y);
  const [a, b] = length > 1 ? [x / length, y / length] : [x, y];
  const c = (before ? 1 : -1) * Math.sqrt(Math.max(0, 1 - a * a - b * b));
  const towards = [0, 1, 2].map((axis) => a * right[axis]! + b * up[axis]! + c * out[axis]!) as [
    number,
    number,
    number,
  ];
  const elevation = Math.asin(Math.min(1, Math.max(-1, towards[1]))) / DEGREE;
  return {
    azimuth: around(Math.atan2(towards[0], towards[2]) / DEGREE),
    elevation: Math.min(HIGHEST_SUN, Math.max(LOWEST_SUN, elevation)),
  };
}

/** Which way the eye looks from, in degrees as an azimuth is. */
export function azimuthOfEye([right]: ScreenAxes): number {
  return around(Math.atan2(-right[2], right[0]) / DEGREE);
}

/** An azimuth from 0 up to 360 degrees. */
export function around(azimuth: number): number {
  const turned = azimuth % 360;
  return turned < 0 ? turned + 360 : turned;
}

/** Follows a finger over the dome: past its rim the sun goes round to the other side of the tree. */
export class SunDrag {
  #before: boolean;
  #outside = false;

  constructor(before: boolean) {
    this.#before = before;
  }

  to(right: number, up: number): DomePlace {
    const outside = Math.hypot(right, up) > 1;
    if (outside && !this.#outside) {
      this.#before = !this.#before;
    }
    this.#outside = outside;
    return { right, up, before: this.#before };
  }
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
