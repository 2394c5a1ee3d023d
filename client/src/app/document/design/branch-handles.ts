import type { Envelope } from "../../../scene/structure/envelope-surface";
import { periphery, surface } from "../../../scene/structure/envelope-surface";
import type { Vec3 } from "../../../scene/vector";
import type { DesignEdit } from "../../../wire/generated";
import type { BranchShape } from "./branch-shape";
import type { KeyName } from "./design-model";
import { angleBetween, dot, minus, plus, size, type Turn, times, turned } from "./space";

/** What handles are about; those of one are shown at a time. */
export const HANDLE_GROUPS = ["way", "outline", "axis"] as const;
export type HandleGroup = (typeof HANDLE_GROUPS)[number];

/** What handles need of the picture. */
export interface HandleView {
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  projector(): (point: Vec3) => readonly [number, number] | null;
}

/** What a drag makes of a branch. */
export interface Dragged {
  /** As it is to be drawn until the server has answered. */
  readonly shape: BranchShape;
  readonly change: Change;
  readonly readout: Readout;
}

/** What is said of the branch by it. */
export type Change =
  | { readonly kind: "value"; readonly key: KeyName; readonly value: unknown; readonly isPrivate: boolean }
  | { readonly kind: "edits"; readonly edits: readonly DesignEdit[]; readonly keys: readonly KeyName[] };

/** Numbers to be shown beside the finger. */
export interface Readout {
  /** In internodes. */
  readonly length?: number;
  /** In degrees. */
  readonly angle?: number;
  readonly width?: number;
  readonly height?: number;
  readonly shape?: number;
  /** As a share of the bearer's axis. */
  readonly place?: number;
  /** Whether the finger is lower than a tip can be. */
  readonly isLowest?: boolean;
}

/** What a drag begins with. */
export interface Held {
  readonly shape: BranchShape;
  readonly bearer: BranchShape | null;
  /** Its roll in degrees and its height in internodes, as they are in force. */
  readonly roll: number;
  readonly height: number;
}

/** Something of a branch that a finger can move. */
export interface Handle {
  readonly id: string;
  readonly group: HandleGroup;
  /** What it looks like: a point to move, or one that comes to be where it is pulled. */
  readonly isNew?: boolean;
  place(shape: BranchShape): Vec3;
  /** With the finger here; nothing where that means nothing. */
  drag(held: Held, view: HandleView, x: number, y: number): Dragged | null;
  /** Whether it would come to lie so near to the axis that nothing could be read from a finger. */
  hides?(shape: BranchShape, project: (point: Vec3) => readonly [number, number] | null): boolean;
  /** What a double tap does. */
  readonly without?: (shape: BranchShape) => Change;
}

/** Handles nearer to what they are measured from than this, in pixels, are hidden. */
const TOO_NEAR = 16;
/** The same of those that change how a half bulges, which would lie upon others on a small shell. */
const TOO_SMALL = 44;
const WIDEST = 4;
const [LEAST_SHAPE, MOST_SHAPE] = [0.2, 8];
/** How far a place on the surface is from the middle, at which its bulge is taken hold of. */
const BULGE = 0.55;
const MOST_POINTS = 24;
/** Nothing is said of places farther out, or lower below the ground (`LM2`). */
const [FARTHEST, LOWEST] = [1000, -10];

/** All handles that a branch has. */
export function handlesOf(shape: BranchShape): readonly Handle[] {
  const isStem = shape.path === "/";
  return [
    ...(isStem ? [STEM_TIP] : [TIP, BASE, ROLL]),
    ...[0, 1, 2, 3].map((at) => sideHandle(at as Side)),
    TOP,
    BOTTOM,
    bulge("upper"),
    bulge("lower"),
    ...axisHandles(shape),
  ];
}

const TIP: Handle = {
  id: "tip",
  group: "way",
  place: (shape) => shape.tip,
  drag: ({ shape }, view, x, y) => {
    const wanted = view.pointOnPlane(x, y, shape.tip);
    // What is drawn is what is said: a tip goes no lower than the server takes it.
    const tip = wanted && tidyPlace(wanted);
    if (!wanted || !tip || size(minus(tip, shape.base)) < 0.5) {
      return null;
    }
    const way = minus(tip, shape.base);
    return {
      shape: shape.aimed(tip),
      change: { kind: "edits", edits: [{ edit: "aim", node: shape.path, tip }], keys: ["turn", "reach"] },
      readout: {
        length: size(way),
        angle: angleBetween(shape.placed.heading, way),
        isLowest: wanted[1] < LOWEST,
      },
    };
  },
};

/** The plant as a whole grows and shrinks; where its stem goes, its axis says. */
const STEM_TIP: Handle = {
  id: "tip",
  group: "way",
  place: (shape) => shape.tip,
  drag: ({ shape, height }, view, x, y) => {
    const to = view.pointOnPlane(x, y, shape.tip);
    const along = to ? dot(minus(to, shape.base), shape.direction) : 0;
    const wanted = round(clamp((height * along) / shape.placed.length, 4, 400), 10);
    if (!to || along <= 0) {
      return null;
    }
    const length = (shape.placed.length * wanted) / height;
    return {
      shape: shape.aimed(plus(shape.base, times(shape.direction, length))),
      change: { kind: "value", key: "height", value: wanted, isPrivate: false },
      readout: { length },
    };
  },
};

/** Where the branch leaves its bearer: it slides along. */
const BASE: Handle = {
  id: "base",
  group: "way",
  place: (shape) => shape.base,
  drag: ({ shape, bearer }, view, x, y) => {
    if (!bearer) {
      return null;
    }
    const project = view.projector();
    let [place, least] = [0, Number.POSITIVE_INFINITY];
    for (let step = 2; step <= 98; step += 1) {
      const at = project(bearer.along(bearer.curve.at(step / 100)));
      const far = at ? Math.hypot(at[0] - x, at[1] - y) : least;
      if (far < least) {
        [place, least] = [step / 100, far];
      }
    }
    const by = minus(bearer.along(bearer.curve.at(place)), shape.base);
    return {
      shape: shape.movedBy(by),
      change: { kind: "edits", edits: [{ edit: "anchor", node: shape.path, at: place }], keys: [] },
      readout: { place },
    };
  },
};

const ROLL: Handle = {
  id: "roll",
  group: "way",
  place: (shape) => plus(middle(shape), turned(shape.placed.frame as Turn, [rollArm(shape), 0, 0])),
  drag: ({ shape, roll }, view, x, y) => {
    const to = view.pointOnPlane(x, y, middle(shape));
    if (!to) {
      return null;
    }
    // A way across the axis on the screen is a turn about it: an arm's length turns it by a quarter.
    const [side, aside] = [
      turned(shape.placed.frame as Turn, [1, 0, 0]),
      turned(shape.placed.frame as Turn, [0, 0, 1]),
    ];
    const off = minus(to, middle(shape));
    const by = (Math.atan2(dot(off, aside), dot(off, side)) * 180) / Math.PI;
    const value = round(clamp(around(roll + by), -360, 360), 1);
    return {
      shape: shape.rolled(by),
      change: { kind: "value", key: "roll", value, isPrivate: true },
      readout: { angle: value },
    };
  },
};

type Side = 0 | 1 | 2 | 3;

/** One of the four places where the silhouette is widest. */
function sideHandle(side: Side): Handle {
  const angle = (side * Math.PI) / 2;
  const axis = side % 2 === 0 ? 0 : 2;
  return {
    id: `side-${side}`,
    group: "outline",
    place: (shape) => shape.outward(periphery(shape.envelope, angle)),
    hides: (shape, project) => {
      const [, height] = periphery(shape.envelope, angle);
      return isNear(project, shape.outward(periphery(shape.envelope, angle)), shape.outward([0, height, 0]));
    },
    drag: ({ shape }, view, x, y) => {
      const { envelope } = shape;
      const to = view.pointOnPlane(x, y, shape.outward(periphery(envelope, angle)));
      if (!to) {
        return null;
      }
      const local = shape.inward(to);
      const out = (side < 2 ? 1 : -1) * local[axis];
      const radius = round(clamp(out, 0.02, WIDEST), 1000);
      const height = round(clamp(local[1], envelope.bottom[1] + 0.02, envelope.top[1] - 0.02), 1000);
      const opposite = ((side + 2) % 4) as Side;
      // Sides that are alike stay alike.
      const together = envelope.radii[side] === envelope.radii[opposite] ? [side, opposite] : [side];
      const put = (list: readonly number[], value: number) =>
        list.map((old, at) => (together.includes(at as Side) ? value : old)) as unknown as Envelope["radii"];
      return withEnvelope(
        shape,
        { ...envelope, radii: put(envelope.radii, radius), heights: put(envelope.heights, height) },
        { width: radius * shape.scale, height: height * shape.scale },
      );
    },
  };
}

const TOP: Handle = poleHandle("top");
const BOTTOM: Handle = poleHandle("bottom");

function poleHandle(pole: "top" | "bottom"): Handle {
  return {
    id: pole,
    group: "outline",
    place: (shape) => shape.outward(shape.envelope[pole]),
    drag: ({ shape }, view, x, y) => {
      const { envelope } = shape;
      const to = view.pointOnPlane(x, y, shape.outward(envelope[pole]));
      if (!to) {
        return null;
      }
      const [across, up, aside] = shape.inward(to);
      const limit = pole === "top" ? Math.max(...envelope.heights) + 0.02 : Math.min(...envelope.heights) - 0.02;
      const height = pole === "top" ? clamp(up, limit, WIDEST) : clamp(up, -WIDEST, limit);
      const place: Vec3 = [upright(across), round(height, 1000), upright(aside)];
      return withEnvelope(shape, { ...envelope, [pole]: place }, { height: place[1] * shape.scale });
    },
  };
}

/** How much a half of the silhouette bulges. */
function bulge(half: "upper" | "lower"): Handle {
  const isUpper = half === "upper";
  return {
    id: half,
    group: "outline",
    place: (shape) => shape.outward(surface(shape.envelope, 0, BULGE, isUpper)),
    hides: (shape, project) => {
      const [, height] = surface(shape.envelope, 0, BULGE, isUpper);
      const at = shape.outward(surface(shape.envelope, 0, BULGE, isUpper));
      return isNear(project, at, shape.outward([0, height, 0]), TOO_SMALL);
    },
    drag: ({ shape }, view, x, y) => {
      const { envelope } = shape;
      const to = view.pointOnPlane(x, y, shape.outward(surface(envelope, 0, BULGE, isUpper)));
      if (!to) {
        return null;
      }
      const [pole, rim] = [(isUpper ? envelope.top : envelope.bottom)[1], periphery(envelope, 0)[1]];
      const share = clamp((shape.inward(to)[1] - pole) / (rim - pole), 1e-3, 0.999);
      const exponent = round(clamp(Math.log(share) / Math.log(BULGE), LEAST_SHAPE, MOST_SHAPE), 100);
      return withEnvelope(shape, { ...envelope, [half]: exponent }, { shape: exponent });
    },
  };
}

function withEnvelope(shape: BranchShape, envelope: Envelope, readout: Readout): Dragged {
  return {
    shape: shape.shaped(envelope),
    change: { kind: "value", key: "silhouette", value: envelope, isPrivate: false },
    readout,
  };
}

/** The points of its axis, and between each two of them one that is not there yet. */
function axisHandles(shape: BranchShape): readonly Handle[] {
  const { points } = shape.curve;
  const handles: Handle[] = [];
  for (let at = 0; at + 1 < points.length; at += 1) {
    if (at > 0) {
      handles.push(pointHandle(`point-${at}`, points, at, false));
    }
    if (points.length < MOST_POINTS) {
      const added = [...points.slice(0, at + 1), between(shape, at), ...points.slice(at + 1)];
      handles.push(pointHandle(`new-${at}`, added, at + 1, true));
    }
  }
  return handles;
}

function pointHandle(id: string, points: readonly Vec3[], at: number, isNew: boolean): Handle {
  const own = points[at] ?? [0, 0, 0];
  const bend = (list: readonly Vec3[]): Change => ({ kind: "value", key: "axis", value: list, isPrivate: true });
  return {
    id,
    group: "axis",
    isNew,
    place: (shape) => shape.along(shape.curve.points.length === points.length ? (shape.curve.points[at] ?? own) : own),
    drag: ({ shape }, view, x, y) => {
      const to = view.pointOnPlane(x, y, shape.along(own));
      if (!to) {
        return null;
      }
      const [across, up, aside] = shape.beside(to);
      const within = (part: number) => round(clamp(part, -WIDEST, WIDEST), 1000);
      const place: Vec3 = [within(across), within(up), within(aside)];
      const list = points.map((point, index) => (index === at ? place : point));
      const isApart = list.every((point, index) => index === 0 || size(minus(point, list[index - 1] ?? point)) > 0.01);
      const off = Math.hypot(across, aside) * shape.placed.length;
      return isApart ? { shape: shape.bent(list), change: bend(list), readout: { width: off } } : null;
    },
    ...(isNew ? {} : { without: () => bend(points.filter((_, index) => index !== at)) }),
  };
}

/** A place on the axis between two of its points. */
function between({ curve }: BranchShape, at: number): Vec3 {
  const [from, to] = [nearest(curve.places, curve.points[at]), nearest(curve.places, curve.points[at + 1])];
  const place = curve.places[Math.round((from + to) / 2)] ?? [0, 0.5, 0];
  return [round(place[0], 1000), round(place[1], 1000), round(place[2], 1000)];
}

function nearest(places: readonly Vec3[], to: Vec3 = [0, 0, 0]): number {
  const distances = places.map((place) => size(minus(place, to)));
  return distances.indexOf(Math.min(...distances));
}

function middle(shape: BranchShape): Vec3 {
  return plus(shape.base, times(shape.direction, shape.placed.length / 2));
}

function rollArm(shape: BranchShape): number {
  return 0.3 * shape.placed.length;
}

function isNear(
  project: (point: Vec3) => readonly [number, number] | null,
  a: Vec3,
  b: Vec3,
  pixels = TOO_NEAR,
): boolean {
  const [here, there] = [project(a), project(b)];
  return !here || !there || Math.hypot(here[0] - there[0], here[1] - there[1]) < pixels;
}

/** Nearly above the middle is above the middle. */
function upright(part: number): number {
  return Math.abs(part) < 0.04 ? 0 : round(clamp(part, -WIDEST, WIDEST), 1000);
}

function around(degrees: number): number {
  return ((((degrees + 180) % 360) + 360) % 360) - 180;
}

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

function round(value: number, parts: number): number {
  return Math.round(value * parts) / parts;
}

/** A place that can be said of: to a thousandth, and within the scene. */
export function tidyPlace([x, y, z]: Vec3): [number, number, number] {
  const within = (part: number, least: number) => round(clamp(part, least, FARTHEST), 1000);
  return [within(x, -FARTHEST), within(y, LOWEST), within(z, -FARTHEST)];
}
