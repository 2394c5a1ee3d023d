import { FLAT_NOISE_SIDE, lattice } from "../noise-texture";

/** Drifts in which grass is not mown: of each noise how fine it is, its seed and its share, and between which sums they begin. */
const DRIFTS = [
  { wave: 0.055, seed: 43, share: 0.62 },
  { wave: 0.17, seed: 44, share: 0.38 },
] as const;
const BEGINS = [0.5, 0.66] as const;

const real = (value: number) => value.toFixed(3);

/** Where grass has not been mown, for shaders. */
export const UNMOWN = /* glsl */ `
/** Where grass has not been mown, 0 to 1; \`meadow.ts\` has the same. */
float unmownAt(vec2 at) {
  return smoothstep(${BEGINS.map(real).join(", ")}, ${DRIFTS.map(({ wave, seed, share }) => `${real(share)} * noise(at * ${real(wave)}, ${real(seed)})`).join(" + ")});
}
`;

/** Where grass has not been mown, 0 to 1. */
export function unmownAt(x: number, z: number): number {
  const sum = DRIFTS.reduce((all, { wave, seed, share }) => all + share * noiseAt(x * wave, z * wave, seed), 0);
  return eased(Math.min(1, Math.max(0, (sum - BEGINS[0]) / (BEGINS[1] - BEGINS[0]))));
}

let values: Uint8Array | null = null;

/** The shaders' noise in a plane. */
function noiseAt(x: number, z: number, seed: number): number {
  values ??= lattice(FLAT_NOISE_SIDE ** 2, 2);
  const [u, v] = [x + 17.13 * seed, z + 31.71 * seed];
  const [i, k] = [Math.floor(u), Math.floor(v)];
  const [s, t] = [eased(u - i), eased(v - k)];
  const at = (column: number, line: number) =>
    values![(line & (FLAT_NOISE_SIDE - 1)) * FLAT_NOISE_SIDE + (column & (FLAT_NOISE_SIDE - 1))]!;
  const [near, far] = [k, k + 1].map((line) => at(i, line) + s * (at(i + 1, line) - at(i, line))) as [number, number];
  return (near + t * (far - near)) / 255;
}

function eased(t: number): number {
  return t * t * (3 - 2 * t);
}
