import type { Pose } from "../../../wire/generated";

/** How a thing is turned, in degrees: around the vertical, and before that up on its own x axis' side. */
export interface Turning {
  readonly turn: number;
  readonly tilt: number;
}

type Rotation = NonNullable<Pose["rotation"]>;

/** The rotation that tilts, then turns. */
export function rotationOf({ turn, tilt }: Turning): Rotation {
  const [a, b] = [(turn * Math.PI) / 360, (tilt * Math.PI) / 360];
  const [sa, ca, sb, cb] = [Math.sin(a), Math.cos(a), Math.sin(b), Math.cos(b)];
  return [sa * sb, sa * cb, ca * sb, ca * cb];
}

/** How a rotation turns and tilts; what it does beside is left out. */
export function turningOf([x, y, z, w]: Rotation = [0, 0, 0, 1]): Turning {
  // Where the thing's own x axis points.
  const ax = 1 - 2 * (y * y + z * z);
  const ay = 2 * (x * y + w * z);
  const az = 2 * (x * z - w * y);
  // Adding zero makes −0 plain.
  const degrees = (radians: number) => Math.round((radians * 1800) / Math.PI) / 10 + 0;
  return {
    turn: degrees(Math.atan2(-az, ax)),
    tilt: degrees(Math.asin(Math.min(1, Math.max(-1, ay)))),
  };
}
