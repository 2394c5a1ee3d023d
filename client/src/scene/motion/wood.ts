import { MIN_RADIUS, POSITION_STEPS } from "../../wire/generated";
import type { Limbs, MotionRows } from "./limbs";

/** Mass of green wood with its water, kg/m³, and of a leaf's area, kg/m². */
const WOOD_DENSITY = 950;
const LEAF_DENSITY = 0.2;
/** Area of a leaf as a share of its length squared, and the share of it that the wind takes hold of. */
export const LEAF_FORM = 0.4;
export const LEAF_DRAG = 0.2;
/** Young's modulus of green wood along the grain, Pa. */
export const STIFFNESS = 7e9;
/** e^0.01: the ratio of neighbouring codes of radii. */
const RATIO = 1.010050167084168;

/** Lengths that rows are measured in. */
export interface Scale {
  /** Metres in one internode. */
  readonly internodeLength: number;
  /** Middle length of a leaf, in internodes. */
  readonly leafSize: number;
}

/** The wood and leaves of each row, in metres, kilogrammes and seconds; nothing for seeds and the dead. */
export interface Wood {
  readonly parent: Int32Array;
  /** Where each ends: x y z. */
  readonly place: Float64Array;
  /** The way from the node below it; none for a seed. */
  readonly way: Float64Array;
  /** Its middle. */
  readonly middle: Float64Array;
  readonly length: Float64Array;
  /** With its leaves. */
  readonly mass: Float64Array;
  /** Area to the wind with its leaves, times the coefficient of drag. */
  readonly dragArea: Float64Array;
  /** How much it bends under a moment of 1 Nm before calibration, in radians. */
  readonly softness: Float64Array;
}

/**
 * What rows are made of. Like all that joints are made from it is made with + − × ÷ and square roots in the order in which the
 * server makes it (`server/motion`), so that both find the same bits.
 */
export function woodOf(rows: MotionRows, limbs: Limbs, { internodeLength, leafSize }: Scale): Wood {
  const { parent, quantised, radiusCode, leaves } = rows;
  const count = parent.length;
  const place = new Float64Array(3 * count);
  const way = new Float64Array(3 * count);
  const middle = new Float64Array(3 * count);
  const length = new Float64Array(count);
  const mass = new Float64Array(count);
  const dragArea = new Float64Array(count);
  const softness = new Float64Array(count);
  const radii = radiiUpTo(radiusCode.reduce((most, code) => Math.max(most, code), 0));
  const radius = (row: number) => internodeLength * radii[radiusCode[row]!]!;
  const leafLength = leafSize * internodeLength;
  const leafArea = LEAF_FORM * leafLength * leafLength;
  for (let row = 0; row < count; row += 1) {
    const node = parent[row]!;
    for (let at = 3 * row, axis = 0; axis < 3; at += 1, axis += 1) {
      place[at] = (quantised[at]! / POSITION_STEPS) * internodeLength;
      if (node >= 0) way[at] = place[at]! - place[3 * node + axis]!;
      middle[at] = place[at]! - 0.5 * way[at]!;
    }
    const limb = limbs.of[row]!;
    if (limb < 0) continue;
    // What goes on in its limb is as thick as both its ends on average; the first of a limb has no end of its own below.
    const below = limbs.of[node] === limb ? node : row;
    const mean = 0.5 * (radius(below) + radius(row));
    const x = way[3 * row]!;
    const y = way[3 * row + 1]!;
    const z = way[3 * row + 2]!;
    const long = Math.sqrt(x * x + y * y + z * z);
    const area = leaves[row]! * leafArea;
    length[row] = long;
    mass[row] = WOOD_DENSITY * Math.PI * mean * mean * long + LEAF_DENSITY * area;
    dragArea[row] = 2 * mean * long + LEAF_DRAG * area;
    const squared = mean * mean;
    softness[row] = squared === 0 ? 0 : long / (STIFFNESS * (0.25 * Math.PI) * squared * squared);
  }
  return { parent, place, way, middle, length, mass, dragArea, softness };
}

/** The radius of each code up to `most`, in internodes, by multiplication alone; 0 for code 0. */
export function radiiUpTo(most: number): Float64Array {
  const radii = new Float64Array(most + 1);
  let radius = MIN_RADIUS;
  for (let code = 1; code <= most; code += 1) {
    radii[code] = radius;
    radius *= RATIO;
  }
  return radii;
}
