import type { Vec3 } from "../vector";
import type { SkyLight } from "./sky-light";

/** Directions in which the sky is looked at, evenly spread. */
const LOOKS = 192;
/** What a constant of each order is of the light that comes to a surface, and of how its polynomial is normed. */
const SHARES = [1, 2, 2, 2, 3.75, 3.75, 0.3125, 3.75, 0.9375] as const;
/** Surfaces take so much of what there is; what comes from below is dimmer still. */
const TAKEN = 0.8;
const BELOW = 0.55;
/** Clouds, where the sky is full of them, are so much of what is seen of it. */
const CLOUDED = 0.55;
/** How much lighter a studio's walls are than what lies between them, and its lamp's side than the other. */
const WALLS = 0.42;
const LAMP = 0.22;

/** Nine colours, for the polynomials of `ambient` in `glsl/common.ts`. */
export type Harmonics = readonly Vec3[];

/** The light of a sky and of the ground from all around, as smooth as a dull surface sees it (R. Ramamoorthi and P. Hanrahan, 2001). */
export function harmonicsOf(light: SkyLight): Harmonics {
  const looks = Array.from({ length: LOOKS }, (_, n) => lookAt(n));
  const colours = looks.map((look) => (look[1] > 0 ? skyAt(light, look) : null));
  // The top of things is as bright as it is known to be; the sky says how that changes towards its sides.
  const above = [0, 0, 0];
  for (const [n, colour] of colours.entries()) {
    if (colour) for (let c = 0; c < 3; c += 1) above[c]! += (4 * colour[c]! * looks[n]![1]) / LOOKS;
  }
  const sums = SHARES.map(() => [0, 0, 0] as [number, number, number]);
  for (const [n, look] of looks.entries()) {
    const parts = polynomials(look);
    for (let c = 0; c < 3; c += 1) {
      const colour = colours[n];
      const from = colour ? (light.above[c]! * colour[c]!) / Math.max(above[c]!, 1e-6) : light.below[c]! * BELOW;
      for (let i = 0; i < 9; i += 1) sums[i]![c]! += (TAKEN * SHARES[i]! * parts[i]! * from) / LOOKS;
    }
  }
  return sums;
}

/** The light of a soft box above and of the floor, and of two walls: one beside the lamp, one across from it. */
export function studioOf({ above, below, towards: [x, , z] }: SkyLight): Harmonics {
  const of = (share: number, low = 0) =>
    [0, 1, 2].map((c) => 0.5 * TAKEN * (share * above[c]! + low * BELOW * below[c]!)) as unknown as Vec3;
  const wide = Math.max(x * x + z * z, 1e-6);
  const far = Math.sqrt(wide);
  const none = of(0);
  // What looks to neither wall is darker: round wood is seen to be round.
  const walls = [of((4 * WALLS * x * z) / wide), of((WALLS * (x * x - z * z)) / wide)] as const;
  return [of(1, 1), of(1, -1), of((LAMP * z) / far), of((LAMP * x) / far), none, none, none, ...walls];
}

/** What the sky's shader shows in a direction, without what stands before it; stars give no light. */
export function skyAt({ zenith, middle, horizon, glow, cloud, clouds, towards }: SkyLight, look: Vec3): Vec3 {
  const length = Math.hypot(...towards);
  const toSun = Math.max(0, (look[0] * towards[0] + look[1] * towards[1] + look[2] * towards[2]) / length);
  const flat = Math.hypot(look[0], look[2]) * Math.hypot(towards[0], towards[2]);
  const aside = 0.5 - (0.5 * (look[0] * towards[0] + look[2] * towards[2])) / Math.max(flat, 1e-6);
  const cool = 0.55 * aside * (1 - rise(0.02, 0.36, towards[1] / length));
  const [low, high] = [rise(-0.02, 0.26, look[1]), rise(0.12, 0.9, look[1])];
  const around = 0.5 * toSun ** 5 + 1.2 * toSun ** 60;
  return [0, 1, 2].map((c) => {
    const rim = horizon[c]! + (middle[c]! - horizon[c]!) * cool;
    const clear = rim + (middle[c]! - rim) * low;
    const sky = clear + (zenith[c]! - clear) * high + glow[c]! * around;
    return sky + (cloud[c]! - sky) * CLOUDED * clouds;
  }) as unknown as Vec3;
}

function polynomials([x, y, z]: Vec3): readonly number[] {
  return [1, y, z, x, x * y, y * z, 3 * y * y - 1, x * z, x * x - z * z];
}

/** The nth of directions that are spread evenly, by the golden angle. */
function lookAt(n: number): Vec3 {
  const y = 1 - (2 * n + 1) / LOOKS;
  const flat = Math.sqrt(1 - y * y);
  const turn = 2.399963229728653 * n;
  return [flat * Math.cos(turn), y, flat * Math.sin(turn)];
}

/** As the shaders' own `smoothstep`. */
function rise(low: number, high: number, value: number): number {
  const t = Math.min(1, Math.max(0, (value - low) / (high - low)));
  return t * t * (3 - 2 * t);
}
