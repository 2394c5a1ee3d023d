import { leafHash } from "../leaf-hash";
import type { SwayingJoints } from "./answers";
import type { Grown, Joints } from "./joints";
import { NONE } from "./limbs";
import type { Loads } from "./loads";
import { type Hinges, hingesOf } from "./pose";
import { RIDE } from "./rides";

/** Numbers each row has on the graphics card: its ride; where the twig stands that it shivers with, and its own number, or −1. */
export const ROW_NUMBERS = 12;
export const PIVOT = RIDE;
export const PHASE = RIDE + 3;

/** What the page needs of joints that a worker has made. Lengths of rows and hinges are in internodes, as the picture's are. */
export interface Moving {
  /** Rows it was made from. */
  readonly rowCount: number;
  /** The lowest row of each joint. */
  readonly first: Int32Array;
  readonly joints: SwayingJoints;
  /** How each joint turns under what may lie on the tree. */
  readonly loads: Loads;
  readonly hinges: Hinges;
  /** See `ROW_NUMBERS`. */
  readonly rows: Float32Array;
}

/** Of joints as they were made. */
export function movingOf({ limbs, wood, joints }: Grown, loads: Loads, internodeLength: number): Moving {
  const hinges = hingesOf(joints, wood);
  const per = 1 / internodeLength;
  const each = hinges.numbers.length / Math.max(1, hinges.count);
  // Places and the two vectors of a ride are lengths, the numbers between them are not.
  const isLength = Array.from({ length: each }, (_, i) => i % (each / 2) < 3 || i % (each / 2) >= 5);
  for (let at = 0; at < hinges.numbers.length; at += 1) if (isLength[at % each]) hinges.numbers[at]! *= per;
  const count = wood.parent.length;
  const rows = new Float32Array(ROW_NUMBERS * count);
  for (let row = 0; row < count; row += 1) {
    const to = ROW_NUMBERS * row;
    const from = RIDE * row;
    rows[to] = joints.rides[from]!;
    rows[to + 1] = joints.rides[from + 1]!;
    for (let a = 2; a < RIDE; a += 1) rows[to + a] = joints.rides[from + a]! * per;
    rows[to + PHASE] = -1;
    const limb = limbs.of[row]!;
    if (limb === NONE || joints.rides[from] === NONE) continue;
    const parent = wood.parent[row]!;
    const below = ROW_NUMBERS * parent;
    if (rows[below + PHASE]! >= 0) for (let a = PIVOT; a < ROW_NUMBERS; a += 1) rows[to + a] = rows[below + a]!;
    else if (limbs.first[limb] === row && !isJoint(joints, row)) {
      for (let a = 0; a < 3; a += 1) rows[to + PIVOT + a] = wood.place[3 * parent + a]! * per;
      rows[to + PHASE] = leafHash(row) / 2 ** 32;
    }
  }
  const { count: jointCount, frequency, damping, drag, compliance, centre, area } = joints;
  return {
    rowCount: count,
    first: joints.first,
    joints: { count: jointCount, frequency, damping, drag, compliance, centre, area },
    loads,
    hinges,
    rows,
  };
}

/** Whether a limb's lowest row is where a joint begins. */
function isJoint(joints: Joints, row: number): boolean {
  const joint = joints.rides[RIDE * row]!;
  return joint !== NONE && joints.first[joint] === row;
}

/** How far each joint turns where the nodes of rows turn like this under a load: the part of it that its shape can show. */
export function sagOf({ limbs, wood, joints }: Grown, turns: Float64Array): Float64Array {
  const sag = new Float64Array(3 * joints.count);
  for (let joint = 0; joint < joints.count; joint += 1) {
    const first = joints.first[joint]!;
    const limb = limbs.of[first]!;
    const node = joints.node[joint]!;
    let squares = 0;
    for (let at = limbs.begin[limb]!; at < limbs.begin[limb + 1]!; at += 1) {
      const row = limbs.rows[at]!;
      const weight = joints.rides[RIDE * row + 1]!;
      const counts = wood.length[row]! * weight;
      squares += counts * weight;
      for (let a = 0; a < 3; a += 1) sag[3 * joint + a]! += counts * (turns[3 * row + a]! - turns[3 * node + a]!);
    }
    const share = squares > 0 ? joints.softness[joint]! / squares : 0;
    for (let a = 0; a < 3; a += 1) sag[3 * joint + a]! *= share;
  }
  return sag;
}
