import type { Vec3 } from "../vector";

/** The outline of a branching system, its base in the origin; units are free (`server/design/src/envelope.rs`). */
export interface Envelope {
  readonly top: Vec3;
  readonly bottom: Vec3;
  /** How far the periphery reaches towards +x, +z, −x and −z. */
  readonly radii: readonly [number, number, number, number];
  /** How high it stands there. */
  readonly heights: readonly [number, number, number, number];
  /** Shape above the periphery: 1 a cone, 2 an ovoid, more a cylinder, less a spire. */
  readonly upper: number;
  /** Shape below it. */
  readonly lower: number;
  /** What comes to lie on the bearer's outline. */
  readonly tip: Vec3;
}

/** Top and bottom stand within this share of the periphery, as the server has it. */
const INNER = 0.98;

/** A point of the periphery. */
export function periphery({ radii, heights }: Envelope, angle: number): Vec3 {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [right, before] = [cos >= 0 ? 0 : 2, sin >= 0 ? 1 : 3] as const;
  return [radii[right] * cos, heights[right] * cos * cos + heights[before] * sin * sin, radii[before] * sin];
}

/** A point of the surface: `share` is 1 at the periphery and 0 at the top, or at the bottom below it. */
export function surface(envelope: Envelope, angle: number, share: number, upper: boolean): Vec3 {
  const rim = periphery(envelope, angle);
  const [pole, shape] = upper ? [envelope.top, envelope.upper] : [envelope.bottom, envelope.lower];
  const [x, z] = within(envelope, pole);
  return [x + (rim[0] - x) * share, pole[1] + (rim[1] - pole[1]) * share ** shape, z + (rim[2] - z) * share];
}

/** Where a pole stands within the periphery, seen from above. */
function within({ radii }: Envelope, [x, , z]: Vec3): readonly [number, number] {
  const out = Math.hypot(x / radii[x >= 0 ? 0 : 2], z / radii[z >= 0 ? 1 : 3]);
  return out > INNER ? [(x * INNER) / out, (z * INNER) / out] : [x, z];
}
