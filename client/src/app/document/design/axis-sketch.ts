import type { Vec3 } from "../../../scene/vector";
import { tidyPlace } from "./branch-handles";
import type { BranchShape } from "./branch-shape";
import { type Curve, isApart, tidy } from "./curve-points";
import { across, dot, minus, plus, size, times, unit } from "./space";

type Pixel = readonly [x: number, y: number];

/** What a drawn axis needs of the picture. */
export interface AxisView {
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  projector(): (point: Vec3) => Pixel | null;
}

/** What comes of an axis that was drawn. */
export interface DrawnAxis {
  readonly tip: Vec3;
  /** The course in the frame that the branch has once its tip is there. */
  readonly points: Curve;
  /** The branch as it is to be drawn until the server has answered. */
  readonly shape: BranchShape;
}

/** Shorter, in pixels, it is none. */
const SHORTEST = 24;
/** So near to the base, in pixels, a stroke means to begin there. */
const AT_BASE = 90;
/** How exactly its points follow it, in lengths of its chord, and how many there are at most. */
const [EXACT, MOST_POINTS] = [0.008, 12];
/** A side whose sine to the branch is smaller says nothing (`server/design/src/frame.rs`). */
const LEAST_SINE = 0.1;

/**
 * The course of a branch as somebody has drawn it on the picture: from its base to where the stroke ends, at the depths
 * that the branch had. A stroke that ends at the base was drawn the other way about; one that begins elsewhere is moved
 * there.
 */
export function drawnAxis(
  shape: BranchShape,
  view: AxisView,
  trace: readonly Pixel[],
  roll: number,
): DrawnAxis | "small" {
  const base = view.projector()(shape.base);
  const [first, last] = [trace[0], trace.at(-1)];
  if (!base || !first || !last || lengthOf(trace) < SHORTEST) {
    return "small";
  }
  const isBackward = apart(last, base) < Math.min(apart(first, base), AT_BASE);
  const strokes = isBackward ? [...trace].reverse() : trace;
  const begin = strokes[0] ?? first;
  const off: Pixel = [base[0] - begin[0], base[1] - begin[1]];
  const isAtBase = Math.hypot(...off) < AT_BASE;
  const [whole, steps] = [lengthOf(strokes), stepsOf(strokes)];
  const places = strokes.flatMap(([x, y], at): Vec3[] => {
    const share = (steps[at] ?? 0) / whole;
    const shift = isAtBase ? 1 - share : 1;
    const through = shape.along(shape.curve.at(share));
    const place = view.pointOnPlane(x + shift * off[0], y + shift * off[1], through);
    return place ? [place] : [];
  });
  const tip = tidyPlace(places.at(-1) ?? shape.base);
  const chord = minus(tip, shape.base);
  if (places.length < 2 || size(chord) < 0.5) {
    return "small";
  }
  const few = simple([shape.base, ...places.slice(1, -1), tip], size(chord));
  const frame = frameOf(shape, unit(chord), roll);
  const local = (place: Vec3): Vec3 => {
    const from = times(minus(place, shape.base), 1 / size(chord));
    return [tidy(dot(from, frame[0])), tidy(dot(from, frame[1])), tidy(dot(from, frame[2]))];
  };
  const aimed = shape.aimed(tip);
  const ended = (inner: Curve): Curve => [[0, 0, 0], ...inner, [0, 1, 0]];
  const points = spread(ended(few.slice(1, -1).map(local)));
  const drawn = spread(ended(few.slice(1, -1).map((place) => aimed.beside(place))));
  return { tip, points, shape: aimed.bent(drawn) };
}

/** The frame that the server gives a branch which goes this way: X on the side that looks up, and then its roll. */
export function frameOf(shape: BranchShape, direction: Vec3, roll: number): readonly [Vec3, Vec3, Vec3] {
  if (shape.path === "/") {
    const side = firstAcross(
      [
        [1, 0, 0],
        [0, -1, 0],
      ],
      direction,
    ) ?? [0, 0, 1];
    return [side, direction, across(side, direction)];
  }
  const heading = shape.placed.heading as unknown as Vec3;
  const side = firstAcross([[0, 1, 0], heading, [1, 0, 0], [0, 0, 1]], direction) ?? [1, 0, 0];
  const aside = across(side, direction);
  const [sin, cos] = [Math.sin((roll * Math.PI) / 180), Math.cos((roll * Math.PI) / 180)];
  return [plus(times(side, cos), times(aside, sin)), direction, minus(times(aside, cos), times(side, sin))];
}

/** The first of these sides that says something, squared with a direction. */
function firstAcross(sides: readonly Vec3[], direction: Vec3): Vec3 | null {
  for (const side of sides) {
    const square = minus(side, times(direction, dot(side, direction)));
    if (size(square) > LEAST_SINE) {
      return unit(square);
    }
  }
  return null;
}

/** The same course through few points (Douglas and Peucker). */
function simple(places: readonly Vec3[], chord: number): readonly Vec3[] {
  for (let exact = EXACT * chord; ; exact *= 1.5) {
    const few = within(places, exact);
    if (few.length <= MOST_POINTS) {
      return few;
    }
  }
}

function within(places: readonly Vec3[], exact: number): readonly Vec3[] {
  const [first, last] = [places[0], places.at(-1)];
  if (!first || !last || places.length < 3) {
    return places;
  }
  const far = places.map((place) => besideLine(place, first, last));
  const most = Math.max(...far);
  if (most <= exact) {
    return [first, last];
  }
  const at = far.indexOf(most);
  return [...within(places.slice(0, at + 1), exact).slice(0, -1), ...within(places.slice(at), exact)];
}

function besideLine(place: Vec3, first: Vec3, last: Vec3): number {
  const [way, from] = [minus(last, first), minus(place, first)];
  const share = Math.min(Math.max(dot(from, way) / Math.max(dot(way, way), 1e-9), 0), 1);
  return size(minus(from, times(way, share)));
}

/** Without points that lie upon the one before. */
function spread(points: Curve): Curve {
  const kept: Vec3[] = [];
  points.forEach((point, at) => {
    const isLast = at === points.length - 1;
    while (isLast && kept.length > 1 && !isApart([kept.at(-1) ?? point, point])) {
      kept.pop();
    }
    if (isLast || kept.length === 0 || isApart([kept.at(-1) ?? point, point])) {
      kept.push(point);
    }
  });
  return kept;
}

function stepsOf(trace: readonly Pixel[]): readonly number[] {
  let sum = 0;
  return trace.map((pixel, at) => {
    sum += at === 0 ? 0 : apart(pixel, trace[at - 1] ?? pixel);
    return sum;
  });
}

function lengthOf(trace: readonly Pixel[]): number {
  return stepsOf(trace).at(-1) ?? 0;
}

function apart(a: Pixel, b: Pixel): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
