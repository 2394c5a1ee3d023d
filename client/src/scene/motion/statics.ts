import type { Wood } from "./wood";

/** How much less a rod of wood resists being twisted than being bent. */
const TWIST = 6;

/** What each row bears, itself included: Σ w, and Σ w x in metres. */
export interface Borne {
  readonly weight: Float64Array;
  readonly moment: Float64Array;
}

/** Of weights of rows, which act in their middles. */
export function borneBy({ parent, middle }: Wood, weights: Float64Array): Borne {
  const weight = weights.slice();
  const moment = new Float64Array(middle.length);
  for (let row = 0, at = 0; row < weight.length; row += 1, at += 3) {
    const own = weights[row]!;
    moment[at] = own * middle[at]!;
    moment[at + 1] = own * middle[at + 1]!;
    moment[at + 2] = own * middle[at + 2]!;
  }
  for (let row = weight.length - 1; row >= 0; row -= 1) {
    const node = parent[row]!;
    if (node < 0) continue;
    weight[node]! += weight[row]!;
    moment[3 * node]! += moment[3 * row]!;
    moment[3 * node + 1]! += moment[3 * row + 1]!;
    moment[3 * node + 2]! += moment[3 * row + 2]!;
  }
  return { weight, moment };
}

/** Σ w |x|² over what each row bears, itself included. */
export function spreadOf({ parent, middle }: Wood, weights: Float64Array): Float64Array {
  const spread = new Float64Array(weights.length);
  for (let row = 0; row < spread.length; row += 1) {
    const x = middle[3 * row]!;
    const y = middle[3 * row + 1]!;
    const z = middle[3 * row + 2]!;
    spread[row] = weights[row]! * (x * x + y * y + z * z);
  }
  for (let row = spread.length - 1; row >= 0; row -= 1) {
    const node = parent[row]!;
    if (node >= 0) spread[node]! += spread[row]!;
  }
  return spread;
}

/** Adds how a row turns from its lower end to its upper under unit loads along x, y and z, column by column. */
export function addBend(out: Float64Array, wood: Wood, borne: Borne, weights: Float64Array, row: number): void {
  const { middle, way } = wood;
  const at = 3 * row;
  const weight = borne.weight[row]!;
  const sixth = weights[row]! / 6;
  const lx = borne.moment[at]! - weight * middle[at]! + sixth * way[at]!;
  const ly = borne.moment[at + 1]! - weight * middle[at + 1]! + sixth * way[at + 1]!;
  const lz = borne.moment[at + 2]! - weight * middle[at + 2]! + sixth * way[at + 2]!;
  const softness = wood.softness[row]!;
  const length = wood.length[row]!;
  const ax = length > 0 ? way[at]! / length : 0;
  const ay = length > 0 ? way[at + 1]! / length : 0;
  const az = length > 0 ? way[at + 2]! / length : 0;
  // The moment of each load is the lever across it.
  let along = (TWIST - 1) * (ay * lz - az * ly);
  out[0]! += softness * (along * ax);
  out[1]! += softness * (lz + along * ay);
  out[2]! += softness * (along * az - ly);
  along = (TWIST - 1) * (az * lx - ax * lz);
  out[3]! += softness * (along * ax - lz);
  out[4]! += softness * (along * ay);
  out[5]! += softness * (lx + along * az);
  along = (TWIST - 1) * (ax * ly - ay * lx);
  out[6]! += softness * (ly + along * ax);
  out[7]! += softness * (along * ay - lx);
  out[8]! += softness * (along * az);
}

/** How the nodes of all rows turn under loads along y, each the row's weight times `force`: x y z for each row, in radians. */
export function turnsUnder(wood: Wood, weights: Float64Array, force: number): Float64Array {
  const { parent, middle, way, length, softness } = wood;
  const count = weights.length;
  const weight = weights.slice();
  // A load along y has no moment that its own height would be a part of.
  const momentX = new Float64Array(count);
  const momentZ = new Float64Array(count);
  for (let row = 0; row < count; row += 1) {
    momentX[row] = weights[row]! * middle[3 * row]!;
    momentZ[row] = weights[row]! * middle[3 * row + 2]!;
  }
  for (let row = count - 1; row >= 0; row -= 1) {
    const node = parent[row]!;
    if (node < 0) continue;
    weight[node]! += weight[row]!;
    momentX[node]! += momentX[row]!;
    momentZ[node]! += momentZ[row]!;
  }
  const turns = new Float64Array(3 * count);
  for (let row = 0; row < count; row += 1) {
    const node = parent[row]!;
    if (node < 0) continue;
    const at = 3 * row;
    const sixth = weights[row]! / 6;
    const lx = momentX[row]! - weight[row]! * middle[at]! + sixth * way[at]!;
    const lz = momentZ[row]! - weight[row]! * middle[at + 2]! + sixth * way[at + 2]!;
    const long = length[row]!;
    const ax = long > 0 ? way[at]! / long : 0;
    const ay = long > 0 ? way[at + 1]! / long : 0;
    const az = long > 0 ? way[at + 2]! / long : 0;
    // As in `addBend`, of its second column.
    const along = (TWIST - 1) * (az * lx - ax * lz);
    const soft = softness[row]!;
    turns[at] = turns[3 * node]! + soft * (along * ax - lz) * force;
    turns[at + 1] = turns[3 * node + 1]! + soft * (along * ay) * force;
    turns[at + 2] = turns[3 * node + 2]! + soft * (lx + along * az) * force;
  }
  return turns;
}
