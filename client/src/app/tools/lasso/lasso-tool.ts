import type { Vec3 } from "../../../scene/vector";
import { type Command, type DrawingPlane, FARTHEST, MAX_OUTLINE_POINTS } from "../../../wire/generated";
import type { StrokePoint } from "../../input/gesture-recogniser";
import type { BrushView } from "../../view/brush-view";
import type { Copy } from "../symmetry/symmetry";
import { PICK_TOLERANCE, type Tool, tidy } from "../tool";
import { enclosedArea, type Point2, simplifiedTo } from "./outline";
import type { OutlineTaker } from "./outline-trace";

/** A smaller loop, in square pixels, is a slip of the finger. */
const LEAST_AREA = 900;
/** And one of less than this, in square internodes, has no room for a shoot. */
const LEAST_ROOM = 2;
/** Places closer to the one before say nothing new, in pixels. */
const SPACING = 2;
/** How far a point may lie beside the outline that is sent, in pixels. */
const TOLERANCE = 0.7;

/** What the lasso needs of the view. */
export interface LassoView extends Pick<BrushView, "pick" | "pointOnPlane"> {
  /** What turns points of the world into places on the canvas. */
  projector(): (point: Vec3) => Point2 | null;
  /** The plane parallel to the screen through a point, with axes to the right and upwards. */
  drawingPlane(through: Vec3): DrawingPlane;
}

export interface LassoOptions {
  readonly view: LassoView;
  readonly submit: (command: Command) => void;
  /** The branch that alone may grow, as a row (`SG1`). */
  readonly bud: () => number | null;
  /** Where an outline lies in depth if it begins beside every branch. */
  readonly base: (x: number, y: number) => Vec3;
  /** Who gets the outline, if not the tree. */
  readonly taker: () => OutlineTaker | null;
  /** What is drawn from a place on the canvas, and its repetitions. */
  readonly copies: (row: number | null, x: number, y: number) => readonly Copy[];
  /** A number no other gesture of this client has. */
  readonly newGesture: () => number;
  /** How deep the body becomes: 1 is as deep as wide. */
  readonly depth: () => number;
  /** The outline as far as it is drawn, and its repetitions, in pixels; null for none. */
  readonly draw: (outline: readonly Point2[] | null, repeated: readonly (readonly Point2[])[]) => void;
  /** Outlines were sent; these are their points in the world. */
  readonly sent: (outlines: readonly (readonly Vec3[])[]) => void;
  /** A loop too small to grow into. */
  readonly tooSmall: () => void;
  /** The server would not grow into an outline. */
  readonly refused: () => void;
}

/** Turns a stroke into the outline of a crown. */
export class LassoTool implements Tool {
  #options: LassoOptions;
  #outline: Point2[] | null = null;
  /** The drawing plane passes through this point, parallel to the screen. */
  #through: Vec3 = [0, 0, 0];
  /** The outline itself and its repetitions. */
  #copies: readonly Copy[] = [];

  constructor(options: LassoOptions) {
    this.#options = options;
  }

  begin(point: StrokePoint): void {
    const { view, base, copies, taker } = this.#options;
    const other = taker();
    const picked = other ? null : view.pick(point.x, point.y, PICK_TOLERANCE);
    this.#through = other?.through ?? picked?.point ?? base(point.x, point.y);
    this.#copies = other ? [] : copies(picked?.row ?? null, point.x, point.y);
    this.#outline = [];
    this.move([point]);
  }

  move(points: readonly StrokePoint[]): void {
    const outline = this.#outline;
    if (!outline) {
      return;
    }
    for (const { x, y } of points) {
      const last = outline[outline.length - 1];
      if (last === undefined || Math.hypot(x - last[0], y - last[1]) >= SPACING) {
        outline.push([x, y]);
      }
    }
    this.#options.draw(outline, this.#repeated(outline));
  }

  end(): void {
    const drawn = this.#outline;
    this.abandon();
    if (!drawn) {
      return;
    }
    const { view, bud, depth, submit, sent, tooSmall, taker } = this.#options;
    const plane = view.drawingPlane(this.#through);
    const places = this.#placesOf(simplifiedTo(drawn, TOLERANCE, MAX_OUTLINE_POINTS));
    const outline = places.map((place) => onPlane(place, plane));
    if (enclosedArea(drawn) < LEAST_AREA || enclosedArea(outline) < LEAST_ROOM) {
      tooSmall();
      return;
    }
    const flat = depth() < 1 ? { depth: depth() } : {};
    const other = taker();
    if (other) {
      other.take({ outline, plane, ...flat });
      return;
    }
    const row = bud();
    const copies = this.#copies;
    const joined = copies.length > 1 ? { gesture: this.#options.newGesture() } : {};
    for (const copy of copies) {
      submit({
        kind: "lasso",
        outline,
        plane: planeOf(copy, plane),
        ...flat,
        ...(row === null ? {} : { bud: row }),
        ...joined,
      });
    }
    sent(copies.map(({ place }) => places.map(place)));
  }

  abandon(): void {
    this.#outline = null;
    this.#options.draw(null, []);
  }

  #placesOf(outline: readonly Point2[]): Vec3[] {
    return outline.flatMap(([x, y]) => {
      const place = this.#options.view.pointOnPlane(x, y, this.#through);
      return place ? [place] : [];
    });
  }

  /** The outline's repetitions on the canvas. */
  #repeated(outline: readonly Point2[]): Point2[][] {
    const [, ...others] = this.#copies;
    if (others.length === 0) {
      return [];
    }
    const project = this.#options.view.projector();
    const places = this.#placesOf(outline);
    return others.map(({ place }) =>
      places.flatMap((point) => {
        const at = project(place(point));
        return at ? [at] : [];
      }),
    );
  }

  refused({ kind }: Command): void {
    if (kind === "lasso") {
      this.#options.refused();
    }
  }
}

/** Where a repetition of what lies on a plane lies. */
function planeOf({ place, direction }: Copy, { origin, right, up }: DrawingPlane): DrawingPlane {
  return { origin: [...place(origin)], right: [...direction(right)], up: [...direction(up)] };
}

function onPlane(place: Vec3, { origin, right, up }: DrawingPlane): [number, number] {
  const along = (axis: Vec3) =>
    (place[0] - origin[0]) * axis[0] + (place[1] - origin[1]) * axis[1] + (place[2] - origin[2]) * axis[2];
  const clamp = (value: number) => tidy(Math.min(FARTHEST, Math.max(-FARTHEST, value)));
  return [clamp(along(right)), clamp(along(up))];
}
