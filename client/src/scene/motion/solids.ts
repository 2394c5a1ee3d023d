import type { PlacedShape, Pose } from "../../wire/generated";
import type { Vec3 } from "../vector";
import type { Ray, TriangleTree } from "./triangle-tree";

/** What an obstacle is around its own origin, in internodes: half the sides of a box, the radius of a ball, or triangles. */
type Form =
  | { readonly kind: "box"; readonly half: Vec3 }
  | { readonly kind: "ball"; readonly radius: number }
  | { readonly kind: "mesh"; readonly triangles: TriangleTree };

/** An obstacle in its place, as the wind meets it. Lengths are in internodes but for those that say otherwise. */
export interface Solid {
  readonly form: Form;
  /** Metres of an internode. */
  readonly unit: number;
  /** From the axes of the world to its own, column by column. */
  readonly back: Float64Array;
  readonly place: Vec3;
  /** The middle of its box in the world's axes, in metres, and how far it reaches from there. */
  readonly middle: Vec3;
  readonly reach: number;
  /** How high it is, in metres: what of it is above the ground. */
  readonly height: number;
  /** The unit vector upwards in its own axes. */
  readonly up: Vec3;
  /** Flat triangles below this are land, seen from its origin. */
  readonly land: number;
}

/** Flat triangles in the lowest part of an obstacle are the land that it stands on. */
const LAND = 0.1;

/** What is known of an obstacle; the triangles of a mesh are those of its shape, in internodes. */
export interface Standing {
  readonly shape: PlacedShape;
  readonly pose: Pose;
  readonly triangles: TriangleTree | null;
}

/** Null where it has nothing that is above the ground, or shelters nothing: all that is below a plane is land. */
export function solidOf({ shape, pose, triangles }: Standing, unit: number): Solid | null {
  const form = formOf(shape, triangles);
  const back = backOf(pose.rotation ?? [0, 0, 0, 1]);
  if (!form || !back) return null;
  // As the server has them, in single precision.
  const place = single(pose.position);
  const up: Vec3 = [back[3]!, back[4]!, back[5]!];
  const { middle, reach, lowest, highest } = extentOf(form, back, up);
  const foot = Math.max(place[1] + lowest, 0);
  const height = place[1] + highest - foot;
  const land = foot + LAND * height - place[1];
  const numbers = [unit, reach, height, ...place, ...middle];
  if (!numbers.every(Number.isFinite) || height <= 0 || unit <= 0) return null;
  return {
    form,
    unit,
    back,
    place,
    middle: [(place[0] + middle[0]) * unit, (place[1] + middle[1]) * unit, (place[2] + middle[2]) * unit],
    reach: reach * unit,
    height: height * unit,
    up,
    land,
  };
}

const RAY: Ray = {
  from: new Float64Array(3),
  way: new Float64Array(3),
  reach: 0,
  up: [0, 1, 0],
  land: 0,
};

/** How far away it is, in metres, from a place in a direction; infinitely where it is not within `reach`. */
export function firstOf(solid: Solid, [x, y, z]: Vec3, [a, b, c]: Vec3, reach: number): number {
  const { form, unit, back, place } = solid;
  const px = x / unit - place[0];
  const py = y / unit - place[1];
  const pz = z / unit - place[2];
  const { from, way } = RAY;
  for (let axis = 0; axis < 3; axis += 1) {
    from[axis] = back[axis]! * px + back[3 + axis]! * py + back[6 + axis]! * pz;
    way[axis] = back[axis]! * a + back[3 + axis]! * b + back[6 + axis]! * c;
  }
  RAY.reach = reach / unit;
  let away: number;
  if (form.kind === "box") away = sideOfBox(form.half, from, way);
  else if (form.kind === "ball") away = sideOfBall(form.radius, from, way);
  else {
    RAY.up = solid.up;
    RAY.land = solid.land;
    away = form.triangles.first(RAY);
  }
  return away < RAY.reach ? away * unit : Number.POSITIVE_INFINITY;
}

function formOf(shape: PlacedShape, triangles: TriangleTree | null): Form | null {
  switch (shape.kind) {
    case "box": {
      const [x, y, z] = single(shape.size);
      return { kind: "box", half: [0.5 * x, 0.5 * y, 0.5 * z] };
    }
    case "sphere":
      return { kind: "ball", radius: Math.fround(shape.radius) };
    case "plane":
      return null;
    case "mesh":
      return triangles && triangles.count > 0 ? { kind: "mesh", triangles } : null;
  }
}

function single(vector: readonly [number, number, number]): Vec3 {
  return [Math.fround(vector[0]), Math.fround(vector[1]), Math.fround(vector[2])];
}

/** The matrix from the world's axes to those that a turn has made of them; null where it is none. */
function backOf(turn: readonly [number, number, number, number]): Float64Array | null {
  const [a, b, c, d] = turn.map(Math.fround) as [number, number, number, number];
  const size = Math.sqrt(a * a + b * b + c * c + d * d);
  if (!(size > 0 && Number.isFinite(size))) return null;
  const [x, y, z, w] = [a / size, b / size, c / size, d / size];
  return Float64Array.of(
    1 - 2 * (y * y + z * z),
    2 * (x * y - z * w),
    2 * (x * z + y * w),
    2 * (x * y + z * w),
    1 - 2 * (x * x + z * z),
    2 * (y * z - x * w),
    2 * (x * z - y * w),
    2 * (y * z + x * w),
    1 - 2 * (x * x + y * y),
  );
}

interface Extent {
  readonly middle: Vec3;
  readonly reach: number;
  readonly lowest: number;
  readonly highest: number;
}

function extentOf(form: Form, back: Float64Array, up: Vec3): Extent {
  if (form.kind === "ball") {
    return { middle: [0, 0, 0], reach: form.radius, lowest: -form.radius, highest: form.radius };
  }
  if (form.kind === "box") {
    const [x, y, z] = form.half;
    const highest = Math.abs(up[0] * x) + Math.abs(up[1] * y) + Math.abs(up[2] * z);
    return { middle: [0, 0, 0], reach: Math.sqrt(x * x + y * y + z * z), lowest: -highest, highest };
  }
  const { corners, bounds } = form.triangles;
  let [lowest, highest] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (let at = 0; at < corners.length; at += 3) {
    const height = up[0] * corners[at]! + up[1] * corners[at + 1]! + up[2] * corners[at + 2]!;
    if (height < lowest) lowest = height;
    if (height > highest) highest = height;
  }
  const own = [0, 1, 2].map((a) => 0.5 * (bounds[a]! + bounds[3 + a]!));
  const half = [0, 1, 2].map((a) => bounds[3 + a]! - own[a]!);
  // The way back is the matrix's own columns.
  const world = (a: number) => back[3 * a]! * own[0]! + back[3 * a + 1]! * own[1]! + back[3 * a + 2]! * own[2]!;
  const reach = Math.sqrt(half[0]! * half[0]! + half[1]! * half[1]! + half[2]! * half[2]!);
  return { middle: [world(0), world(1), world(2)], reach, lowest, highest };
}

/** Where a ray comes into a box, or leaves it from inside. */
function sideOfBox(half: Vec3, from: Float64Array, way: Float64Array): number {
  let [enters, leaves] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  for (const axis of [0, 1, 2] as const) {
    if (way[axis] === 0) {
      if (Math.abs(from[axis]!) > half[axis]) return Number.POSITIVE_INFINITY;
      continue;
    }
    const side = way[axis]! < 0 ? -half[axis] : half[axis];
    enters = Math.max(enters, (-side - from[axis]!) / way[axis]!);
    leaves = Math.min(leaves, (side - from[axis]!) / way[axis]!);
  }
  return beyond(enters, leaves);
}

/** The same of a ball. */
function sideOfBall(radius: number, from: Float64Array, way: Float64Array): number {
  const [x, y, z] = [from[0]!, from[1]!, from[2]!];
  const towards = -(x * way[0]! + y * way[1]! + z * way[2]!);
  const squared = radius * radius - (x * x + y * y + z * z - towards * towards);
  if (squared < 0) return Number.POSITIVE_INFINITY;
  const half = Math.sqrt(squared);
  return beyond(towards - half, towards + half);
}

function beyond(enters: number, leaves: number): number {
  const away = enters > 0 ? enters : leaves;
  return enters <= leaves && away > 0 ? away : Number.POSITIVE_INFINITY;
}
