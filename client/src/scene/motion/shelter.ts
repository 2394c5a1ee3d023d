import type { Vec3 } from "../vector";
import { behindCrowns, RECOVERY } from "./exposure";
import { firstOf, type Solid } from "./solids";
import { axesAlong } from "./wind";
import type { Wood } from "./wood";

/** Rays that look for obstacles, within this angle (radians) upwind, over so many of their heights. */
const RAYS = 8;
const CONE = (10 * Math.PI) / 180;
const REACH = 6;
/** The most that an obstacle takes of the speed. */
const TAKEN = 0.8;
const GOLDEN_ANGLE = 2.39996323;
/** Rows within a cube with edges of so many metres share what they get, and cubes grow by this until there are few enough. */
const EDGE = 0.25;
const GROWS = 1.25;
const MOST_CUBES = 1024;

/**
 * The share of the open wind's speed that each row gets past crowns and obstacles. It is reckoned once for each direction of the
 * wind, which is that of its whole mean, rise included.
 */
export function sharesOf(wood: Wood, along: Vec3, solids: readonly Solid[]): Float64Array {
  const shares = behindCrowns(wood, along);
  if (solids.length > 0) shelter(shares, wood, along, solids);
  return shares;
}

/**
 * Takes what obstacles take. What it costs is bounded by the number of cubes in which rows are, whatever there is of them: rays
 * are asked for once in each, where the drag of its rows acts.
 */
function shelter(shares: Float64Array, { middle, dragArea }: Wood, along: Vec3, solids: readonly Solid[]): void {
  const least = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const most = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  let found = false;
  for (let row = 0; row < dragArea.length; row += 1) {
    if (dragArea[row]! <= 0) continue;
    found = true;
    for (let a = 0; a < 3; a += 1) {
      const at = middle[3 * row + a]!;
      if (at < least[a]!) least[a] = at;
      if (at > most[a]!) most[a] = at;
    }
  }
  if (!found) return;
  let edge = EDGE;
  const counts = (a: number) => Math.floor((most[a]! - least[a]!) / edge) + 1;
  while (counts(0) * counts(1) * counts(2) > MOST_CUBES) edge *= GROWS;
  const [across, upward] = [counts(1), counts(2)];
  const cells = counts(0) * across * upward;
  const cubeOf = new Int16Array(dragArea.length).fill(-1);
  const area = new Float64Array(cells);
  const moment = new Float64Array(3 * cells);
  for (let row = 0; row < dragArea.length; row += 1) {
    const own = dragArea[row]!;
    if (own <= 0) continue;
    const cell = (a: number) => Math.floor((middle[3 * row + a]! - least[a]!) / edge);
    const cube = (cell(0) * across + cell(1)) * upward + cell(2);
    cubeOf[row] = cube;
    area[cube]! += own;
    for (let a = 0; a < 3; a += 1) moment[3 * cube + a]! += own * middle[3 * row + a]!;
  }
  const ways = waysOf(along);
  const shade = new Float64Array(RAYS);
  const reached = new Float64Array(cells);
  for (let cube = 0; cube < cells; cube += 1) {
    if (area[cube] === 0) continue;
    const whole = area[cube]!;
    const place: Vec3 = [moment[3 * cube]! / whole, moment[3 * cube + 1]! / whole, moment[3 * cube + 2]! / whole];
    reached[cube] = shareAt(place, along, ways, solids, shade);
  }
  for (let row = 0; row < shares.length; row += 1) {
    if (cubeOf[row]! >= 0) shares[row]! *= reached[cubeOf[row]!]!;
  }
}

/** The ways of all rays. */
function waysOf(along: Vec3): Vec3[] {
  const [, across, upward] = axesAlong(along);
  return Array.from({ length: RAYS }, (_, ray) => {
    const tilt = CONE * Math.sqrt((ray + 0.5) / RAYS);
    const [sin, cos] = [Math.sin(tilt), Math.cos(tilt)];
    const [aroundSin, aroundCos] = [Math.sin(GOLDEN_ANGLE * ray), Math.cos(GOLDEN_ANGLE * ray)];
    const way = (a: 0 | 1 | 2) => -cos * along[a] + sin * (aroundCos * across[a] + aroundSin * upward[a]);
    return [way(0), way(1), way(2)];
  });
}

/** The share of the open wind's speed at a place. Of obstacles behind each other that one counts for a ray that shelters most. */
function shareAt(
  place: Vec3,
  along: Vec3,
  ways: readonly Vec3[],
  solids: readonly Solid[],
  shade: Float64Array,
): number {
  shade.fill(0);
  for (const solid of solids) {
    if (!mayShelter(solid, place, along)) continue;
    for (let ray = 0; ray < RAYS; ray += 1) {
      const distance = firstAlong(solid, place, ways[ray]!, REACH * solid.height);
      if (distance === Number.POSITIVE_INFINITY) continue;
      shade[ray] = Math.max(shade[ray]!, Math.exp(-distance / (RECOVERY * solid.height)));
    }
  }
  let sum = 0;
  for (const each of shade) sum += each;
  return 1 - (TAKEN * sum) / RAYS;
}

/** How far away a ray meets an obstacle, as `firstOf`; it goes up again from the ground, below which no air flows. */
function firstAlong(solid: Solid, place: Vec3, way: Vec3, reach: number): number {
  const first = firstOf(solid, place, way, reach);
  if (!(way[1] < 0)) return first;
  const down = Math.max(place[1], 0) / -way[1];
  if (first <= down || down >= reach) return first;
  const ground: Vec3 = [place[0] + down * way[0], place[1] + down * way[1], place[2] + down * way[2]];
  return down + firstOf(solid, ground, [way[0], -way[1], way[2]], reach - down);
}

/** Whether the ball around an obstacle is near enough, and meets the cone in which rays go. */
function mayShelter({ middle, reach, height }: Solid, place: Vec3, along: Vec3): boolean {
  const [x, y, z] = [middle[0] - place[0], middle[1] - place[1], middle[2] - place[2]];
  const upwind = -(x * along[0] + y * along[1] + z * along[2]);
  const squared = x * x + y * y + z * z;
  const aside = Math.sqrt(Math.max(0, squared - upwind * upwind));
  // 0.18 is more than the tangent of the cone's angle, 1.02 more than one over its cosine.
  const isNear = upwind > -reach && Math.sqrt(squared) - reach < REACH * height;
  return isNear && aside <= 0.18 * Math.max(0, upwind) + 1.02 * reach;
}
