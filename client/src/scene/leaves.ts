/** Numbers that place one leaf: base x y z, size in leaf sizes, direction x y z, normal x y z, random. */
export const LEAF_NUMBERS = 11;

const GOLDEN_ANGLE = 2.39996323;

/** The hash of rule LF3, in 32-bit wrapping arithmetic. */
export function leafHash(input: number): number {
  const x = (Math.imul(input, 747796405) + 2891336453) >>> 0;
  const y = Math.imul((x >>> ((x >>> 28) + 4)) ^ x, 277803737) >>> 0;
  return ((y >>> 22) ^ y) >>> 0;
}

/**
 * Places leaf `k` of `count` on the metamer of `row` that runs from `a` to `b` (LF1–LF4); false if the metamer has
 * no length, and so no heading.
 */
export function placeLeaf(
  out: Float32Array,
  at: number,
  row: number,
  k: number,
  count: number,
  position: Float32Array,
  from: number,
  to: number,
): boolean {
  const ax = position[3 * from]!;
  const ay = position[3 * from + 1]!;
  const az = position[3 * from + 2]!;
  let hx = position[3 * to]! - ax;
  let hy = position[3 * to + 1]! - ay;
  let hz = position[3 * to + 2]! - az;
  const length = Math.hypot(hx, hy, hz);
  if (length < 1e-6) return false;
  const share = (k + 1) / count;
  out[at] = ax + hx * share;
  out[at + 1] = ay + hy * share;
  out[at + 2] = az + hz * share;
  hx /= length;
  hy /= length;
  hz /= length;
  // LF1: u = h × Y, or h × X where h is nearly vertical; w = h × u.
  let [ux, uy, uz] = Math.abs(hy) > 0.99 ? [0, hz, -hy] : [-hz, 0, hx];
  const un = Math.hypot(ux, uy, uz);
  ux /= un;
  uy /= un;
  uz /= un;
  const wx = hy * uz - hz * uy;
  const wy = hz * ux - hx * uz;
  const wz = hx * uy - hy * ux;
  // LF2
  const azimuth = GOLDEN_ANGLE * row + (2 * Math.PI * k) / count;
  const c = 0.866 * Math.cos(azimuth);
  const s = 0.866 * Math.sin(azimuth);
  let dx = 0.5 * hx + c * ux + s * wx;
  let dy = 0.5 * hy + c * uy + s * wy - 0.15;
  let dz = 0.5 * hz + c * uz + s * wz;
  const dn = Math.hypot(dx, dy, dz);
  dx /= dn;
  dy /= dn;
  dz /= dn;
  const random = leafHash(16 * row + k) / 2 ** 32;
  out[at + 3] = 0.75 + 0.5 * random;
  out[at + 4] = dx;
  out[at + 5] = dy;
  out[at + 6] = dz;
  // LF4: Y made perpendicular to d, or h where d is nearly vertical.
  const vertical = Math.abs(dy) > 0.99;
  const [gx, gy, gz] = vertical ? [hx, hy, hz] : [0, 1, 0];
  const along = gx * dx + gy * dy + gz * dz;
  const nx = gx - along * dx;
  const ny = gy - along * dy;
  const nz = gz - along * dz;
  const nn = Math.hypot(nx, ny, nz);
  out[at + 7] = nx / nn;
  out[at + 8] = ny / nn;
  out[at + 9] = nz / nn;
  out[at + 10] = random;
  return true;
}
