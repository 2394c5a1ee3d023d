import { type Mode, RIGID, Stations } from "./frequency";
import { type Limbs, limbsOf, type MotionRows, NONE } from "./limbs";
import { JOINT, RIDE, ridesOf } from "./rides";
import { Shapes } from "./shapes";
import { dampingByCompany } from "./siblings";
import { type Borne, borneBy, spreadOf } from "./statics";
import { wholeRates } from "./whole";
import { type Scale, type Wood, woodOf } from "./wood";

/** The most joints of a table, slowest first. */
const MAX_JOINTS = 4096;
/** Limbs slower than this are joints, in Hz and as a multiple of their trunk's frequency, before calibration. */
const SLOW = 2.5;
const SLOW_BESIDE_TRUNK = 4;
/** Whole trees swing at about 2.4 Hz / √(height in metres) (Jackson 2021). */
const OBSERVED = 2.4;
/** The most by which wood is made softer to swing as observed, and stiffer: as stiff as the stiffest green wood, of 11 GPa. */
const SOFTEST = 1 / 9;
const STIFFEST = 11 / 7;
/** The share of its polar inertia with which what is borne turns about an axis across it. */
const ACROSS = 2 / 3;
const TAU = 2 * Math.PI;

/** The limbs that move, those that bear before those that are borne. */
export interface Joints {
  readonly count: number;
  /** The lowest row of each, and the row at whose node it turns. */
  readonly first: Int32Array;
  readonly node: Int32Array;
  /** The joint that carries that node; none where it is the ground or stiff wood. */
  readonly parent: Int32Array;
  /** How many joints lie between it and the ground. */
  readonly level: Int32Array;
  /** Undamped frequency after calibration, Hz. */
  readonly frequency: Float64Array;
  /** Damping of wood and company as a share of the critical one. */
  readonly damping: Float64Array;
  /** Σ A y² / Σ m y², m²/kg: times dq/dU / 2ω it is the damping by air. */
  readonly drag: Float64Array;
  /** How much softer its wood is than uncalibrated. */
  readonly softness: Float64Array;
  /** By how much it turns where it turns most, in radians for each Pa along x, y and z, column by column. */
  readonly compliance: Float64Array;
  /** Where the drag of all it bears acts on average, m. */
  readonly centre: Float64Array;
  /** Drag area of all it bears, m². */
  readonly area: Float64Array;
  /** The lowest row that rides on it at rest. */
  readonly lowest: Int32Array;
  /** How each row rides; see `rides.ts`. */
  readonly rides: Float64Array;
}

/** A plant's joints with what they are made of. */
export interface Grown {
  readonly limbs: Limbs;
  readonly wood: Wood;
  readonly joints: Joints;
}

/** From rows to joints in one go. */
export function jointsOf(rows: MotionRows, scale: Scale, suppleness: number): Grown {
  const limbs = limbsOf(rows);
  const wood = woodOf(rows, limbs, scale);
  return { limbs, wood, joints: jointsIn(rows, limbs, wood, suppleness) };
}

/** O(rows), apart from ordering limbs by frequency. `suppleness` is the user's: wood that much softer than calibrated. */
function jointsIn(rows: MotionRows, limbs: Limbs, wood: Wood, suppleness: number): Joints {
  const drag = borneBy(wood, wood.dragArea);
  const mass = borneBy(wood, wood.mass);
  const modes = modesOf(limbs, wood, mass, drag);
  const plants = plantsOf(rows, limbs, wood, modes, mass);
  const plantOf = plantsOfLimbs(limbs);
  const isTrunk = trunksOf(rows, limbs);
  const chosen = chosenOf(limbs, modes, isTrunk, (limb) => plants.slow[plantOf[limb]!]!);
  const count = chosen.length;
  const jointOfLimb = new Int32Array(limbs.count).fill(NONE);
  for (const [joint, limb] of chosen.entries()) jointOfLimb[limb] = joint;
  const carriers = carriersOf(limbs, jointOfLimb);
  const whole = () => new Int32Array(count);
  const real = (each = 1) => new Float64Array(each * count);
  const made = {
    count,
    first: whole(),
    node: whole(),
    parent: whole(),
    level: whole(),
    frequency: real(),
    damping: real(),
    drag: real(),
    softness: real(),
    compliance: real(9),
    centre: real(3),
    area: real(),
    lowest: whole(),
  };
  const shapes = new Shapes(limbs, wood, drag);
  for (let joint = 0; joint < count; joint += 1) {
    const limb = chosen[joint]!;
    const first = limbs.first[limb]!;
    const bearer = limbs.bearer[limb]!;
    const parent = bearer === NONE ? NONE : carriers[bearer]!;
    const softness = suppleness / plants.softer[plantOf[limb]!]!;
    const { compliance } = shapes.find(limb);
    const own = modes.rate[limb]!;
    // A trunk swings with all that it bears.
    const rate = isTrunk(limb) ? Math.min(own, plants.whole[plantOf[limb]!]!) : own;
    made.first[joint] = first;
    made.node[joint] = limbs.node[limb]!;
    made.parent[joint] = parent;
    made.level[joint] = parent === NONE ? 0 : made.level[parent]! + 1;
    made.frequency[joint] = Math.sqrt(rate / softness) / TAU;
    made.drag[joint] = modes.drag[limb]!;
    made.softness[joint] = softness;
    for (let e = 0; e < 9; e += 1) made.compliance[9 * joint + e] = compliance[e]! * softness;
    for (let a = 0; a < 3; a += 1) made.centre[3 * joint + a] = drag.moment[3 * first + a]! / drag.weight[first]!;
    made.area[joint] = drag.weight[first]!;
    made.lowest[joint] = first;
  }
  dampingByCompany(made.damping, made.frequency, (joint) => limbs.bearer[chosen[joint]!]!);
  const rides = ridesOf(limbs, wood, jointOfLimb, shapes.weights);
  findLowest(made.lowest, wood, rides);
  return { ...made, rides };
}

/** Makes the lowest row that rides on a joint known to it; of two as low the first. */
function findLowest(lowest: Int32Array, { place }: Wood, rides: Float64Array): void {
  for (let row = 0; RIDE * row < rides.length; row += 1) {
    const joint = rides[RIDE * row + JOINT]!;
    if (joint !== NONE && place[3 * row + 1]! < place[3 * lowest[joint]! + 1]!) lowest[joint] = row;
  }
}

interface Modes {
  readonly rate: Float64Array;
  readonly drag: Float64Array;
}

/** How each limb swings by itself, uncalibrated. */
function modesOf(limbs: Limbs, wood: Wood, mass: Borne, drag: Borne): Modes {
  const massSpread = spreadOf(wood, wood.mass);
  const dragSpread = spreadOf(wood, wood.dragArea);
  const stations = new Stations();
  const modes = { rate: new Float64Array(limbs.count), drag: new Float64Array(limbs.count) };
  const { place, middle } = wood;
  const borne = new Float64Array(2);
  // What a node bears sideways: its weight, and the moment of that when it turns with the node.
  const findBorne = (of: Borne, weights: Float64Array, spread: Float64Array, row: number, onward: number): void => {
    const own = weights[row]!;
    const beyond = onward === NONE ? 0 : of.weight[onward]!;
    const weight = Math.max(of.weight[row]! - own - beyond, 0);
    const at = 3 * row;
    const next = 3 * onward;
    const mx = middle[at]!;
    const my = middle[at + 1]!;
    const mz = middle[at + 2]!;
    const x = place[at]!;
    const y = place[at + 1]!;
    const z = place[at + 2]!;
    const { moment } = of;
    const momentX = moment[at]! - own * mx - (onward === NONE ? 0 : moment[next]!);
    const momentY = moment[at + 1]! - own * my - (onward === NONE ? 0 : moment[next + 1]!);
    const momentZ = moment[at + 2]! - own * mz - (onward === NONE ? 0 : moment[next + 2]!);
    const squares = mx * mx + my * my + mz * mz;
    const moments = x * momentX + y * momentY + z * momentZ;
    const heights = x * x + y * y + z * z;
    const aboutOrigin = Math.max(spread[row]! - own * squares - (onward === NONE ? 0 : spread[onward]!), 0);
    // Steiner, from the origin to the node.
    const aboutNode = aboutOrigin - 2 * moments + weight * heights;
    borne[0] = weight;
    borne[1] = ACROSS * Math.max(aboutNode, 0);
  };
  for (let limb = 0; limb < limbs.count; limb += 1) {
    const begin = limbs.begin[limb]!;
    const end = limbs.begin[limb + 1]!;
    let mode: Mode = RIGID;
    if (end - begin > 1 || limbs.bearer[limb] === NONE) {
      stations.clear();
      for (let at = begin; at < end; at += 1) {
        const row = limbs.rows[at]!;
        const onward = at + 1 < end ? limbs.rows[at + 1]! : NONE;
        findBorne(mass, wood.mass, massSpread, row, onward);
        const borneMass = borne[0]!;
        const borneInertia = borne[1]!;
        findBorne(drag, wood.dragArea, dragSpread, row, onward);
        stations.push(
          wood.length[row]!,
          wood.softness[row]!,
          wood.mass[row]!,
          wood.dragArea[row]!,
          borneMass,
          borneInertia,
          borne[0]!,
          borne[1]!,
        );
      }
      mode = stations.slowest();
    }
    modes.rate[limb] = mode.rate;
    modes.drag[limb] = mode.drag;
  }
  return modes;
}

/** By row of a seed: ω² below which a limb is a joint, and ω² of the whole, before calibration; and what makes the plant swing as observed. */
function plantsOf(rows: MotionRows, limbs: Limbs, wood: Wood, modes: Modes, mass: Borne) {
  const { place } = wood;
  const count = rows.parent.length;
  const slow = new Float64Array(count);
  const softer = new Float64Array(count).fill(1);
  const seed = new Int32Array(count);
  const top = new Float64Array(count);
  for (let row = 0; row < count; row += 1) {
    const parent = rows.parent[row]!;
    top[row] = place[3 * row + 1]!;
    seed[row] = parent < 0 ? row : seed[parent]!;
    if (limbs.of[row] !== NONE) top[seed[row]!] = Math.max(top[seed[row]!]!, place[3 * row + 1]!);
  }
  const whole = wholeRates(wood, mass, seed);
  for (let row = 0; row < count; row += 1) {
    if (rows.parent[row]! >= 0) continue;
    const first = rows.onward[row]!;
    const trunk = first < 0 ? NONE : limbs.of[first]!;
    if (trunk === NONE) continue;
    const rate = modes.rate[trunk]!;
    const height = top[row]! - place[3 * row + 1]!;
    const observed = (OBSERVED * OBSERVED * TAU * TAU) / Math.max(height, 1e-3);
    slow[row] = Math.max(
      SLOW * SLOW * TAU * TAU,
      SLOW_BESIDE_TRUNK * SLOW_BESIDE_TRUNK * (Number.isNaN(rate) ? 0 : rate),
    );
    // A trunk without length swings in no way, and says nothing of what stands beside it.
    const swings = Number.isFinite(rate) && Number.isFinite(whole[row]);
    if (swings) softer[row] = Math.min(Math.max(observed / whole[row]!, SOFTEST), STIFFEST);
  }
  return { slow, softer, whole };
}

/** The seed of each limb's plant. */
function plantsOfLimbs({ count, bearer, node }: Limbs): Int32Array {
  const plants = new Int32Array(count);
  for (let limb = 0; limb < count; limb += 1) {
    plants[limb] = bearer[limb] === NONE ? node[limb]! : plants[bearer[limb]!]!;
  }
  return plants;
}

/** Which limbs go on from a seed. */
function trunksOf({ onward }: MotionRows, { bearer, node, first }: Limbs): (limb: number) => boolean {
  return (limb) => bearer[limb] === NONE && onward[node[limb]!] === first[limb];
}

/** The limbs that move: trunks, and slow limbs of two rows at least; no more than there may be, in ascending order. */
function chosenOf(
  limbs: Limbs,
  { rate }: Modes,
  isTrunk: (limb: number) => boolean,
  slow: (limb: number) => number,
): number[] {
  const chosen: number[] = [];
  for (let limb = 0; limb < limbs.count; limb += 1) {
    const isSlow = rate[limb]! < slow(limb) && limbs.begin[limb + 1]! - limbs.begin[limb]! >= 2;
    if ((isTrunk(limb) && Number.isFinite(rate[limb]!)) || isSlow) chosen.push(limb);
  }
  if (chosen.length <= MAX_JOINTS) return chosen;
  // Trunks first, then the slowest; of two alike the lower row.
  chosen.sort((a, b) => Number(isTrunk(b)) - Number(isTrunk(a)) || rate[a]! - rate[b]! || a - b);
  return chosen.slice(0, MAX_JOINTS).sort((a, b) => a - b);
}

/** The joint that each limb moves with: its own, or the nearest below. */
function carriersOf({ count, bearer }: Limbs, jointOfLimb: Int32Array): Int32Array {
  const carriers = jointOfLimb.slice();
  for (let limb = 0; limb < count; limb += 1) {
    if (carriers[limb] === NONE && bearer[limb] !== NONE) carriers[limb] = carriers[bearer[limb]!]!;
  }
  return carriers;
}
