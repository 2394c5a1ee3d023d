/** Cells of the field along each side. */
export const CROWN_SIDE = 32;
const CELLS = CROWN_SIDE ** 3;
const LAYER = CROWN_SIDE * CROWN_SIDE;
/** How much of a beam a leaf takes that stands at any angle, of its area. */
const TAKEN = 0.5;
/** How high the directions stand from which the sky is looked for, besides straight above. */
const ELEVATION = (37 * Math.PI) / 180;
const AROUND = 6;
/** The zenith counts for so many of those. */
const ABOVE = 1.4;
/** Binomial passes for what shades, and so many more for the way out. */
const SMOOTHED = 3;
/** How steep the density must be, beside itself over one cell, for the way out to be told. */
const TELLING = 0.12;

/** What stands in a box of cells, x first, then y, then z. */
export interface CrownOrder {
  /** Area of leaves in each cell, in square internodes. */
  readonly area: Float32Array<ArrayBuffer>;
  /** How long a cell is along each axis, in internodes. */
  readonly cell: readonly [x: number, y: number, z: number];
}

/**
 * A crown as a cloud: of each cell the way out of it, as far as that can be told, and how open it is to the sky. Four
 * bytes a cell: the way out as −1 to 1, and the openness as 0 to 1.
 */
export function crownField({ area, cell }: CrownOrder): Uint8Array<ArrayBuffer> {
  const volume = cell[0] * cell[1] * cell[2];
  const density = area.map((value) => value / volume);
  smooth(density);
  const open = openness(density, cell);
  for (let n = 0; n < SMOOTHED; n += 1) smooth(density);
  const texels = new Uint8Array(4 * CELLS);
  const width = Math.cbrt(volume);
  for (let at = 0; at < CELLS; at += 1) {
    const x = at % CROWN_SIDE;
    const y = Math.floor(at / CROWN_SIDE) % CROWN_SIDE;
    const z = Math.floor(at / LAYER);
    const out = [
      -slope(density, at, x, 1) / cell[0],
      -slope(density, at, y, CROWN_SIDE) / cell[1],
      -slope(density, at, z, LAYER) / cell[2],
    ] as const;
    const steep = Math.hypot(...out);
    const share = 1 / (steep + (TELLING * density[at]!) / width + 1e-9);
    for (let axis = 0; axis < 3; axis += 1) texels[4 * at + axis] = Math.round(127.5 + 127.5 * out[axis]! * share);
    texels[4 * at + 3] = Math.round(255 * open[at]!);
  }
  return texels;
}

/** Half the difference of what lies on both sides along an axis; beyond the box nothing changes. */
function slope(values: Float32Array, at: number, place: number, stride: number): number {
  const before = place > 0 ? at - stride : at;
  const after = place < CROWN_SIDE - 1 ? at + stride : at;
  return (values[after]! - values[before]!) / 2;
}

/** One pass of 1-2-1 along each axis; nothing stands beyond the box. */
function smooth(values: Float32Array): void {
  for (const stride of [1, CROWN_SIDE, LAYER]) {
    for (let first = 0; first < CELLS; first += 1) {
      if (Math.floor(first / stride) % CROWN_SIDE !== 0) continue;
      let before = 0;
      for (let n = 0, at = first; n < CROWN_SIDE; n += 1, at += stride) {
        const own = values[at]!;
        const after = n < CROWN_SIDE - 1 ? values[at + stride]! : 0;
        values[at] = (before + 2 * own + after) / 4;
        before = own;
      }
    }
  }
}

/** How much of the sky is seen from each cell, 0 to 1: a sweep of layers from above for every direction. */
function openness(density: Float32Array, cell: readonly [number, number, number]): Float32Array {
  const open = new Float32Array(CELLS);
  const weights = ABOVE + AROUND;
  sweep(density, cell, [0, 0], 1, ABOVE / weights, open);
  const flat = 1 / Math.tan(ELEVATION);
  for (let n = 0; n < AROUND; n += 1) {
    const turn = (2 * Math.PI * (n + 0.25)) / AROUND;
    const lean = [flat * Math.cos(turn), flat * Math.sin(turn)] as const;
    sweep(density, cell, lean, 1 / Math.sin(ELEVATION), 1 / weights, open);
  }
  return open;
}

/** Adds what comes from one direction, that leans so far across for each step up and is so much longer than that. */
function sweep(
  density: Float32Array,
  cell: readonly [number, number, number],
  lean: readonly [number, number],
  longer: number,
  weight: number,
  open: Float32Array,
): void {
  let above = new Float32Array(LAYER);
  let here = new Float32Array(LAYER);
  const [dx, dz] = [(lean[0] * cell[1]) / cell[0], (lean[1] * cell[1]) / cell[2]];
  const through = 0.5 * TAKEN * cell[1] * longer;
  for (let y = CROWN_SIDE - 1; y >= 0; y -= 1) {
    for (let z = 0; z < CROWN_SIDE; z += 1) {
      for (let x = 0; x < CROWN_SIDE; x += 1) {
        const own = through * density[(z * CROWN_SIDE + y) * CROWN_SIDE + x]!;
        // In the middle of a cell half of it has been passed.
        const passed = between(above, x + dx, z + dz) + own;
        open[(z * CROWN_SIDE + y) * CROWN_SIDE + x]! += weight * Math.exp(-passed);
        here[z * CROWN_SIDE + x] = passed + own;
      }
    }
    [above, here] = [here, above];
  }
}

/** Of a layer, between its cells; nothing stands beyond it. */
function between(layer: Float32Array, x: number, z: number): number {
  const [i, k] = [Math.floor(x), Math.floor(z)];
  const [u, v] = [x - i, z - k];
  return (
    (1 - v) * ((1 - u) * valueAt(layer, i, k) + u * valueAt(layer, i + 1, k)) +
    v * ((1 - u) * valueAt(layer, i, k + 1) + u * valueAt(layer, i + 1, k + 1))
  );
}

function valueAt(layer: Float32Array, x: number, z: number): number {
  return x < 0 || z < 0 || x >= CROWN_SIDE || z >= CROWN_SIDE ? 0 : layer[z * CROWN_SIDE + x]!;
}
