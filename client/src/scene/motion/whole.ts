import { addBend, type Borne } from "./statics";
import type { Wood } from "./wood";

/**
 * How fast plants swing as a whole, slower than their trunks would by themselves, for what these bear gives way as well: ω² by row
 * of a seed, before calibration, by Rayleigh's quotient. The plant is pulled sideways by its own weight, along x and along z, and
 * the slower counts. Infinite where nothing bends. `seed` has the seed of each row.
 */
export function wholeRates(wood: Wood, mass: Borne, seed: Int32Array): Float64Array {
  const { parent, way } = wood;
  const count = parent.length;
  const rates = new Float64Array(count).fill(Number.POSITIVE_INFINITY);
  const columns = new Float64Array(9);
  for (const axis of [0, 2]) {
    const turn = new Float64Array(3 * count);
    const shift = new Float64Array(3 * count);
    const pulled = new Float64Array(count);
    const moved = new Float64Array(count);
    for (let row = 0, at = 0; row < count; row += 1, at += 3) {
      const node = parent[row]!;
      if (node < 0) continue;
      const below = 3 * node;
      columns.fill(0);
      addBend(columns, wood, mass, wood.mass, row);
      const bx = columns[3 * axis]!;
      const by = columns[3 * axis + 1]!;
      const bz = columns[3 * axis + 2]!;
      const x = turn[below]! + 0.5 * bx;
      const y = turn[below + 1]! + 0.5 * by;
      const z = turn[below + 2]! + 0.5 * bz;
      turn[at] = turn[below]! + bx;
      turn[at + 1] = turn[below + 1]! + by;
      turn[at + 2] = turn[below + 2]! + bz;
      const [wx, wy, wz] = [way[at]!, way[at + 1]!, way[at + 2]!];
      shift[at] = shift[below]! + (y * wz - wy * z);
      shift[at + 1] = shift[below + 1]! + (z * wx - wz * x);
      shift[at + 2] = shift[below + 2]! + (x * wy - wx * y);
      const mx = 0.5 * (shift[below]! + shift[at]!);
      const my = 0.5 * (shift[below + 1]! + shift[at + 1]!);
      const mz = 0.5 * (shift[below + 2]! + shift[at + 2]!);
      const plant = seed[row]!;
      const own = wood.mass[row]!;
      pulled[plant]! += own * (axis === 0 ? mx : mz);
      moved[plant]! += own * (mx * mx + my * my + mz * mz);
    }
    for (let plant = 0; plant < count; plant += 1) {
      if (moved[plant]! > 0) rates[plant] = Math.min(rates[plant]!, pulled[plant]! / moved[plant]!);
    }
  }
  return rates;
}
