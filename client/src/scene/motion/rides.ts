import { type Limbs, NONE } from "./limbs";
import type { Wood } from "./wood";

/** Numbers of a ride: joint; w, the share of its rotation that the row's node has; Σ w t ℓ and Σ w² t ℓ from the joint's node, m. */
export const RIDE = 8;
export const [JOINT, WEIGHT, FIRST, SECOND] = [0, 1, 2, 5];

/**
 * How each row moves with the joint it rides on: when that turns by Θ, θ = |Θ|, its node turns by w Θ and moves by
 * sin θ / θ · Θ × first + (1 − cos θ) / θ² · Θ × (Θ × second). What is no joint goes on as stiffly as the node it stands on.
 * `weights` are those of the joints' nodes, in the order of the limbs' rows.
 */
export function ridesOf(limbs: Limbs, wood: Wood, jointOfLimb: Int32Array, weights: Float64Array): Float64Array {
  const count = wood.parent.length;
  const rides = new Float64Array(RIDE * count);
  for (let to = 0; to < rides.length; to += RIDE) rides[to] = NONE;
  for (let limb = 0; limb < limbs.count; limb += 1) {
    const joint = jointOfLimb[limb]!;
    const begin = limbs.begin[limb]!;
    let below = limbs.node[limb]!;
    for (let at = begin; at < limbs.begin[limb + 1]!; at += 1) {
      const row = limbs.rows[at]!;
      const to = RIDE * row;
      // The first row of a joint begins at rest; all others go on from the row below.
      if (at > begin || joint === NONE) {
        const from = RIDE * below;
        // So few numbers are copied faster one by one.
        for (let a = 0; a < RIDE; a += 1) rides[to + a] = rides[from + a]!;
      } else rides[to] = joint;
      extend(rides, row, wood.way, joint === NONE ? rides[to + WEIGHT]! : weights[at]!);
      below = row;
    }
  }
  return rides;
}

/** From the ride of the node below a row, which stands in the row's place, makes its own: another weight at the end of its way. */
export function extend(rides: Float64Array | Float32Array, row: number, way: ArrayLike<number>, weight: number): void {
  const to = RIDE * row;
  const middle = 0.5 * (rides[to + WEIGHT]! + weight);
  const squared = middle * middle;
  rides[to + WEIGHT] = weight;
  const x = way[3 * row]!;
  const y = way[3 * row + 1]!;
  const z = way[3 * row + 2]!;
  rides[to + FIRST]! += middle * x;
  rides[to + FIRST + 1]! += middle * y;
  rides[to + FIRST + 2]! += middle * z;
  rides[to + SECOND]! += squared * x;
  rides[to + SECOND + 1]! += squared * y;
  rides[to + SECOND + 2]! += squared * z;
}
