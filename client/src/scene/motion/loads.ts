import type { Grown } from "./joints";
import type { MotionRows } from "./limbs";
import { sagOf } from "./moving";
import { turnsUnder } from "./statics";
import { LEAF_DRAG, LEAF_FORM, type Scale, type Wood } from "./wood";

export const GRAVITY = 9.81;
/** Fresh snow, kg/m³. */
const SNOW_DENSITY = 100;
/** A film of 0.2 mm on leaves that rain has wetted, kg/m². */
const FILM = 0.2;
/** Share of a leaf's area that snow lies on: blades overlap, and not all are level. */
const LEVEL = 0.35;
/** Cosines of the slopes on which snow begins to slide off wood, and on which none stays: 40° and 55°. */
const [HOLDS, SLIDES] = [0.77, 0.57];

/** Numbers of each load on a tree: its own weight once more, a metre of snow, rain on all leaves. Of `loadsOf` how each joint turns under it, x y z in radians. */
export interface Loads {
  readonly sag: Float64Array;
  readonly snow: Float64Array;
  readonly rain: Float64Array;
}

/** How much of each there is. */
export type Loading = Readonly<Record<keyof Loads, number>>;

/** Of joints as they were made. */
export function loadsOf(grown: Grown, rows: MotionRows, scale: Scale): Loads {
  const { wood } = grown;
  const masses = massesOn(wood, rows, scale);
  const under = (weights: Float64Array) => sagOf(grown, turnsUnder(wood, weights, -GRAVITY));
  return { sag: under(masses.sag), snow: under(masses.snow), rain: under(masses.rain) };
}

/** What each of the loads weighs on each row, kg. */
export function massesOn(wood: Wood, { leaves }: MotionRows, scale: Scale): Loads {
  const leafLength = scale.leafSize * scale.internodeLength;
  const areas = new Float64Array(leaves.length);
  const films = new Float64Array(leaves.length);
  for (let row = 0; row < leaves.length; row += 1) {
    areas[row] = leaves[row]! * LEAF_FORM * leafLength * leafLength;
    films[row] = wood.length[row]! > 0 ? FILM * areas[row]! : 0;
  }
  return {
    sag: wood.mass,
    snow: snowOn(wood, areas),
    rain: films,
  };
}

/** The mass of a metre of snow on what each row has to hold it, kg. */
function snowOn({ length, way, dragArea }: Wood, leafAreas: Float64Array): Float64Array {
  const snow = new Float64Array(leafAreas.length);
  for (let row = 0; row < snow.length; row += 1) {
    const long = length[row]!;
    if (long <= 0) continue;
    const x = way[3 * row]!;
    const z = way[3 * row + 2]!;
    const level = Math.sqrt(x * x + z * z) / long;
    const holds = Math.min(1, Math.max(0, (level - SLIDES) / (HOLDS - SLIDES)));
    const leaves = leafAreas[row]!;
    const wood = Math.max(0, dragArea[row]! - LEAF_DRAG * leaves);
    snow[row] = SNOW_DENSITY * (wood * level * holds + LEVEL * leaves);
  }
  return snow;
}

/** How much each joint turns under all of it; null where there is nothing. */
export function loaded(loads: Loads, loading: Loading): Float64Array | null {
  const names = (Object.keys(loads) as (keyof Loads)[]).filter((name) => loading[name] > 0);
  if (names.length === 0) return null;
  return loads.sag.map((_, at) => names.reduce((sum, name) => sum + loading[name] * loads[name][at]!, 0));
}
