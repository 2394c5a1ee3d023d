import { FLAT_NOISE_SHIFT, FLAT_NOISE_SIDE, flatLattice } from "../noise-texture";

/** Drifts in which grass is not mown: of each noise how fine it is, its seed and its share, and between which sums they begin. */
const DRIFTS = [
  { wave: 0.055, seed: 43, share: 0.62 },
  { wave: 0.17, seed: 44, share: 0.38 },
] as const;
const BEGINS = [0.47, 0.7] as const;

/** How tall grass is, on the whole and in internodes: where it is mown, and where it is not. */
const TALL = { mown: 0.45, unmown: 1.6 } as const;
/** Dry grass on earth, sand and snow is as tall as if it were so far from mown. */
const DRY_UNMOWN = 0.45;

/** How tall the tallest grass is, and dry grass. */
export const TALLEST_GRASS = TALL.unmown;
export const DRY_GRASS = tallAt(DRY_UNMOWN);

const real = (value: number) => value.toFixed(3);

/** Where grass has not been mown and how tall it is, for shaders. */
export const UNMOWN = /* glsl */ `
const float DRY_UNMOWN = ${real(DRY_UNMOWN)};
/** How tall grass is by how far it is from mown. */
float grassTall(float unmown) { return ${real(TALL.mown)} + ${real(TALL.unmown - TALL.mown)} * unmown; }
/** Where grass has not been mown, 0 to 1; \`meadow.ts\` has the same. */
float unmownAt(vec2 at) {
  return smoothstep(${BEGINS.map(real).join(", ")}, ${DRIFTS.map(({ wave, seed, share }) => `${real(share)} * noise(at * ${real(wave)}, ${real(seed)})`).join(" + ")});
}
`;

/** Where grass has not been mown, 0 to 1. */
export function unmownAt(x: number, z: number): number {
  let sum = 0;
  for (const { wave, seed, share } of DRIFTS) sum += share * noiseAt(x * wave, z * wave, seed);
  return eased(Math.min(1, Math.max(0, (sum - BEGINS[0]) / (BEGINS[1] - BEGINS[0]))));
}

/** How tall grass is that is so far from mown. */
function tallAt(unmown: number): number {
  return TALL.mown + (TALL.unmown - TALL.mown) * unmown;
}

/** How tall grass is at a place. */
export function grassAt(x: number, z: number): number {
  return tallAt(unmownAt(x, z));
}

let values: Uint8Array | null = null;

/** The shaders' noise in a plane. */
function noiseAt(x: number, z: number, seed: number): number {
  values ??= flatLattice();
  const u = x + FLAT_NOISE_SHIFT[0] * seed;
  const v = z + FLAT_NOISE_SHIFT[1] * seed;
  const i = Math.floor(u);
  const k = Math.floor(v);
  const s = eased(u - i);
  const near = valueAt(values, i, k) * (1 - s) + valueAt(values, i + 1, k) * s;
  const far = valueAt(values, i, k + 1) * (1 - s) + valueAt(values, i + 1, k + 1) * s;
  return (near + eased(v - k) * (far - near)) / 255;
}

function valueAt(values: Uint8Array, column: number, line: number): number {
  const last = FLAT_NOISE_SIDE - 1;
  return values[(line & last) * FLAT_NOISE_SIDE + (column & last)]!;
}

function eased(t: number): number {
  return t * t * (3 - 2 * t);
}
