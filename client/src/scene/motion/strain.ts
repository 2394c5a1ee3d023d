import type { Vec3 } from "../vector";
import { type AirSettings, velocityOf } from "./air-settings";
import { pressureOf } from "./answers";
import { limbsOf, type MotionRows } from "./limbs";
import { GRAVITY, type Loads, massesOn } from "./loads";
import { ObstaclesReceived, type PostedObstacles } from "./obstacle-post";
import { sharesOf } from "./shelter";
import type { Solid } from "./solids";
import { borneBy } from "./statics";
import { INTENSITY, profile } from "./wind";
import { type Scale, STIFFNESS, type Wood, woodOf } from "./wood";

/** The bending stress at which green wood breaks, Pa; species lie between 30 and 60 MPa. */
export const STRENGTH = 40e6;
/** The strongest gust of some minutes, in standard deviations above the mean. */
const PEAK = 3.5;

/** What is asked of whoever finds what would break. */
export interface StrainTask {
  readonly rows: MotionRows;
  readonly scale: Scale;
  readonly air: AirSettings;
  /** What stands in the wind. */
  readonly obstacles: PostedObstacles;
}

/** Finds what would break, and remembers the obstacles for the next question. */
export class StrainWork {
  private readonly obstacles = new ObstaclesReceived();

  /** The rows that would break. */
  broken({ rows, scale, air, obstacles }: StrainTask): Int32Array {
    const solids = this.obstacles.receive(obstacles, scale.internodeLength);
    return Int32Array.from(breaking(stressesOf(rows, scale, air, solids)));
  }
}

/**
 * The greatest bending stress at the lower end of each row in the strongest gust of a wind and under all that lies on the tree,
 * in Pa: moment over section modulus, 4 M / π r³. What the tree weighs by itself counts only as far as it sags, for it grew under
 * that. A tree is statically determinate, so that how stiff the wood is does not matter.
 */
export function stressesOf(
  rows: MotionRows,
  scale: Scale,
  air: AirSettings,
  solids: readonly Solid[] = [],
): Float64Array {
  const wood = woodOf(rows, limbsOf(rows), scale);
  const moments = new Float64Array(wood.place.length);
  const velocity = velocityOf(air);
  const speed = Math.hypot(...velocity);
  if (speed > 0) {
    const along: Vec3 = [velocity[0] / speed, velocity[1] / speed, velocity[2] / speed];
    const shares = sharesOf(wood, along, solids);
    const peak = speed * (1 + PEAK * INTENSITY * air.turbulence);
    const [pressure] = pressureOf(peak);
    const sails = wood.dragArea.map((area, row) => area * (profile(wood.middle[3 * row + 1]!) * shares[row]!) ** 2);
    addMoments(moments, wood, sails, [along[0] * pressure, along[1] * pressure, along[2] * pressure]);
  }
  const masses = massesOn(wood, rows, scale);
  for (const load of Object.keys(masses) as (keyof Loads)[]) {
    if (air[load] > 0) addMoments(moments, wood, masses[load], [0, -GRAVITY * air[load], 0]);
  }
  return wood.length.map((_, row) => stressOf(wood, moments, row));
}

/** The rows that bear more than they can stand. */
export function breaking(stresses: Float64Array): number[] {
  const rows: number[] = [];
  for (let row = 0; row < stresses.length; row += 1) if (stresses[row]! > STRENGTH) rows.push(row);
  return rows;
}

/** Adds the moment about the lower end of each row of forces on all that it bears, each a row's weight times `force`. */
function addMoments(moments: Float64Array, wood: Wood, weights: Float64Array, force: Vec3): void {
  const { weight, moment } = borneBy(wood, weights);
  const { place, way } = wood;
  for (let row = 0, at = 0; row < weights.length; row += 1, at += 3) {
    const borne = weight[row]!;
    const x = moment[at]! - borne * (place[at]! - way[at]!);
    const y = moment[at + 1]! - borne * (place[at + 1]! - way[at + 1]!);
    const z = moment[at + 2]! - borne * (place[at + 2]! - way[at + 2]!);
    moments[at]! += y * force[2] - z * force[1];
    moments[at + 1]! += z * force[0] - x * force[2];
    moments[at + 2]! += x * force[1] - y * force[0];
  }
}

/** The part of the moment that bends, as a stress. Softness is ℓ / EJ, and J = π r⁴ / 4. */
function stressOf({ way, length, softness }: Wood, moments: Float64Array, row: number): number {
  const at = 3 * row;
  if (softness[row]! <= 0) return 0;
  const inertia = length[row]! / (STIFFNESS * softness[row]!);
  const radius = ((4 * inertia) / Math.PI) ** 0.25;
  const along =
    (moments[at]! * way[at]! + moments[at + 1]! * way[at + 1]! + moments[at + 2]! * way[at + 2]!) / length[row]!;
  const squared = moments[at]! ** 2 + moments[at + 1]! ** 2 + moments[at + 2]! ** 2;
  return (Math.sqrt(Math.max(0, squared - along ** 2)) * radius) / inertia;
}
