import type { Envelope } from "../../../scene/structure/envelope-surface";
import type { Ray, Vec3 } from "../../../scene/vector";
import type { BranchShape } from "./branch-shape";
import { across, dot, plus, size, type Turn, times, turnedBack, unit } from "./space";

/** What a drawn outline needs of the picture. */
export interface OutlineView {
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  rayAt(x: number, y: number): Ray;
  projector(): (point: Vec3) => readonly [number, number] | null;
}

/** Why nothing comes of it. */
export type Unfitted = "along" | "small";

/** Seen more nearly along its axis than this sine an outline says nothing. */
const LEAST_SINE = 0.35;
/** Narrower or lower, in units of the silhouette, it is none. */
const LEAST = 0.04;
const [LEAST_SHAPE, MOST_SHAPE, SHAPES] = [0.2, 8, 64];
const WIDEST = 4;

/** A place of a drawn outline: across the axis and along it, in units of the silhouette. */
type Drawn = readonly [aside: number, up: number];

/** The silhouette of a branch as somebody has drawn it on the picture, seen from where they look. */
export function fittedOutline(
  shape: BranchShape,
  view: OutlineView,
  trace: readonly (readonly [number, number])[],
): Envelope | Unfitted {
  const middle = plus(shape.base, times(shape.direction, shape.placed.length / 2));
  const on = view.projector()(middle);
  if (!on) {
    return "along";
  }
  const looks = turnedBack(shape.placed.outline as Turn, view.rayAt(on[0], on[1]).direction);
  const sideways = across([0, 1, 0], looks);
  if (size(sideways) < LEAST_SINE) {
    return "along";
  }
  const side = unit(sideways);
  const places = trace.flatMap(([x, y]): Drawn[] => {
    const place = view.pointOnPlane(x, y, middle);
    const local = place && shape.inward(place);
    return local ? [[dot(local, side), local[1]]] : [];
  });
  return fitted(shape.envelope, side, dense(places));
}

/** The envelope nearest to an outline in the plane of its axis and of a direction across. */
export function fitted(before: Envelope, side: Vec3, outline: readonly Drawn[]): Envelope | Unfitted {
  const ups = outline.map(([, up]) => up);
  const [highest, lowest] = [Math.max(...ups), Math.min(...ups)];
  const asides = outline.map(([aside]) => aside);
  if (outline.length < 3 || highest - lowest < LEAST || Math.max(...asides) - Math.min(...asides) < LEAST) {
    return "small";
  }
  const at = (value: number, of: 0 | 1): Drawn => outline.find((place) => place[of] === value) ?? [0, 0];
  const [top, bottom] = [at(highest, 1), at(lowest, 1)];
  const [right, left] = [at(Math.max(...asides), 0), at(Math.min(...asides), 0)];
  // Of the four widths the outline shows two.
  const isX = Math.abs(side[0]) >= Math.abs(side[2]);
  const axis = isX ? 0 : 2;
  const isAlong = side[axis] >= 0;
  const [plusSide, minusSide] = isX ? ([0, 2] as const) : ([1, 3] as const);
  const [forward, backward] = isAlong ? [right, left] : [left, right];
  const [radii, heights] = [[...before.radii], [...before.heights]];
  const isRound = before.radii.every((radius) => radius === before.radii[0]);
  const within = (up: number) => round(clamp(up, lowest + 0.02, highest - 0.02));
  for (const [index, [aside, up]] of [
    [plusSide, forward],
    [minusSide, backward],
  ] as const) {
    radii[index] = round(clamp(Math.abs(aside), 0.02, WIDEST));
    heights[index] = within(up);
  }
  for (const index of isX ? [1, 3] : [0, 2]) {
    // What was round stays full; else depths are not what was drawn, and stay.
    if (isRound) {
      radii[index] = round(((radii[plusSide] ?? 0) + (radii[minusSide] ?? 0)) / 2);
    }
    heights[index] = within(((heights[plusSide] ?? 0) + (heights[minusSide] ?? 0)) / 2);
  }
  const pole = ([aside, up]: Drawn, old: Vec3): Vec3 => {
    const own = round(clamp((isAlong ? 1 : -1) * aside, -WIDEST, WIDEST));
    const height = round(clamp(up, -WIDEST, WIDEST));
    return isX ? [own, height, old[2]] : [old[0], height, own];
  };
  return {
    ...before,
    top: pole(top, before.top),
    bottom: pole(bottom, before.bottom),
    radii: radii as unknown as Envelope["radii"],
    heights: heights as unknown as Envelope["heights"],
    upper: exponent(outline, top, right, left),
    lower: exponent(outline, bottom, right, left),
  };
}

/** How much the half between a pole and the widest places bulges: the exponent that comes nearest to what was drawn. */
function exponent(outline: readonly Drawn[], pole: Drawn, right: Drawn, left: Drawn): number {
  const samples = outline.flatMap(([aside, up]): (readonly [number, number])[] => {
    const rim = aside >= pole[0] ? right : left;
    const [share, rise] = [(aside - pole[0]) / (rim[0] - pole[0]), (up - pole[1]) / (rim[1] - pole[1])];
    // Of the other half, or where nothing can be read.
    return share > 0.05 && share < 0.98 && rise > 0 && rise < 1 ? [[share, rise]] : [];
  });
  let [best, least] = [2, Number.POSITIVE_INFINITY];
  for (let step = 0; step <= SHAPES && samples.length > 0; step += 1) {
    const power = LEAST_SHAPE * (MOST_SHAPE / LEAST_SHAPE) ** (step / SHAPES);
    const off = samples.reduce((sum, [share, rise]) => sum + (share ** power - rise) ** 2, 0);
    if (off < least) {
      [best, least] = [power, off];
    }
  }
  return Math.round(best * 100) / 100;
}

/** The outline closed, with places so near to one another that each of its sides counts by its length. */
function dense(places: readonly Drawn[]): readonly Drawn[] {
  const step = 0.02;
  return places.flatMap((place, index): Drawn[] => {
    const next = places[(index + 1) % places.length] ?? place;
    const pieces = Math.min(Math.max(Math.ceil(Math.hypot(next[0] - place[0], next[1] - place[1]) / step), 1), 200);
    return Array.from({ length: pieces }, (_, piece): Drawn => {
      const share = piece / pieces;
      return [place[0] + (next[0] - place[0]) * share, place[1] + (next[1] - place[1]) * share];
    });
  });
}

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

function round(value: number): number {
  // No −0, which would be another value.
  return Math.round(value * 1000) / 1000 || 0;
}
