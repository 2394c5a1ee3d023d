import type { Vec3 } from "../../../scene/vector";
import { type Command, MAX_STROKE_SAMPLES, type StrokeSample } from "../../../wire/generated";
import type { StrokePoint } from "../../input/gesture-recogniser";
import { FeltPressure, radiusShare } from "../../input/pressure";
import type { BrushView } from "../../view/brush-view";
import type { Copy } from "../symmetry/symmetry";
import { PICK_TOLERANCE, type Tool, tidy, withinReach } from "../tool";
import { MAX_RADIUS } from "./brush-radius";
import { SampleQueue } from "./sample-queue";
import type { StrokeTrail } from "./stroke-trail";

/** Messages that may be in progress; beyond it places gather for the next one. */
const MAX_UNSETTLED = 8;

export interface BrushOptions {
  readonly view: BrushView;
  readonly submit: (command: Command) => void;
  /** The number the next command gets; a stroke goes by that of its first. */
  readonly next: () => number;
  /** What shows strokes until they have grown. */
  readonly trail: Pick<StrokeTrail, "begin" | "add" | "end" | "leave">;
  /** How many `stroke_move` the server has not yet answered. */
  readonly unsettledMoves: () => number;
  readonly radius: () => number;
  /** Whether a pen's pressure widens and narrows the brush. */
  readonly pressureWidens: () => boolean;
  /** The branch that alone may grow, as a row (`SG1`). */
  readonly bud: () => number | null;
  /** Where a stroke lies in depth if it begins beside every branch. */
  readonly base: (x: number, y: number) => Vec3;
  /** What is drawn from a place on the canvas, and its repetitions. */
  readonly copies: (row: number | null, x: number, y: number) => readonly Copy[];
  /** A stroke has ended. */
  readonly drawn: () => void;
}

interface Stroke {
  /** What it is drawn as, each under the stroke's number that the server knows it by. */
  readonly copies: readonly (Copy & { readonly number: number })[];
  /** The drawing plane passes through this point, parallel to the screen. */
  readonly through: Vec3;
  readonly samples: SampleQueue;
  readonly pressure: FeltPressure;
  /** Where the finger is on the canvas. */
  finger: { readonly x: number; readonly y: number };
}

/** Turns the strokes of a finger into commands. */
export class BrushTool implements Tool {
  #options: BrushOptions;
  #stroke: Stroke | null = null;

  constructor(options: BrushOptions) {
    this.#options = options;
  }

  get active(): boolean {
    return this.#stroke !== null;
  }

  begin(point: StrokePoint): void {
    this.end();
    const { next, submit, trail } = this.#options;
    const { through, copies } = this.#begins(point.x, point.y);
    const bud = this.#options.bud();
    // Strokes that overlap in time are one operation (`CM5`).
    const begun = copies.map((copy) => {
      const number = next();
      trail.begin(number);
      submit({ kind: "stroke_begin", stroke: number, ...(bud === null ? {} : { bud }) });
      return { ...copy, number };
    });
    this.#stroke = { copies: begun, through, samples: new SampleQueue(), pressure: new FeltPressure(), finger: point };
    this.move([point]);
  }

  move(points: readonly StrokePoint[]): void {
    const stroke = this.#stroke;
    if (!stroke) {
      return;
    }
    for (const point of points) {
      stroke.finger = point;
      stroke.pressure.follow(point.pressure);
      this.#sample(stroke);
    }
    this.#show(stroke);
  }

  /** Sends what has gathered, or once more the place where the brush rests: it keeps sowing there. */
  tick(): void {
    const stroke = this.#stroke;
    if (!stroke) {
      return;
    }
    // Under a finger that rests the other hand may have turned the tree, or moved the slider.
    const before = stroke.samples.latest;
    this.#sample(stroke);
    if (stroke.samples.latest !== before) {
      this.#show(stroke);
    }
    if (this.#options.unsettledMoves() < MAX_UNSETTLED) {
      this.#send(stroke);
    }
  }

  end(): void {
    const stroke = this.#stroke;
    if (!stroke) {
      return;
    }
    stroke.samples.finish();
    while (stroke.samples.length > 0) {
      this.#send(stroke);
    }
    for (const { number } of stroke.copies) {
      this.#options.trail.end(number, this.#options.next());
      this.#options.submit({ kind: "stroke_end", stroke: number });
    }
    this.#stroke = null;
    this.#options.view.hideBrush();
    this.#options.drawn();
  }

  /** What has grown stays. */
  cancel(): void {
    this.end();
  }

  /** Forgets the stroke without a command, for the server does not know it any more. */
  abandon(): void {
    this.#stroke = null;
    this.#options.view.hideBrush();
    this.#options.trail.leave();
  }

  /** Shows where a stroke beginning here would lie. */
  hover(x: number, y: number): void {
    if (this.#stroke) {
      return;
    }
    const { through, copies } = this.#begins(x, y);
    const place = this.#options.view.pointOnPlane(x, y, through);
    if (place) {
      this.#options.view.showBrush(placesOf(copies, withinReach(place)), this.#radius(null, through));
    } else {
      this.#options.view.hideBrush();
    }
  }

  leave(): void {
    this.#options.view.hideBrush();
  }

  /** Notes where the brush is under the finger, as the camera stands now, unless it is there already. */
  #sample({ finger, through, samples, pressure, copies }: Stroke): void {
    const place = this.#options.view.pointOnPlane(finger.x, finger.y, through);
    if (!place) {
      return;
    }
    const position = withinReach(place);
    const radius = this.#radius(pressure.value, through);
    const { latest } = samples;
    if (latest?.radius !== radius || position.some((value, axis) => value !== latest.position[axis])) {
      samples.add({ position, radius });
      for (const copy of copies) {
        this.#options.trail.add(copy.number, withinReach(copy.place(position)), radius);
      }
    }
  }

  #show({ copies, samples: { latest } }: Stroke): void {
    if (latest) {
      this.#options.view.showBrush(placesOf(copies, latest.position), latest.radius);
    }
  }

  /** Where a stroke from a place on the canvas lies in depth, and what it is drawn as. */
  #begins(x: number, y: number): { readonly through: Vec3; readonly copies: readonly Copy[] } {
    const { view, base, copies } = this.#options;
    const picked = view.pick(x, y, PICK_TOLERANCE);
    return { through: picked?.point ?? base(x, y), copies: copies(picked?.row ?? null, x, y) };
  }

  #send(stroke: Stroke): void {
    const samples: StrokeSample[] = stroke.samples.take(MAX_STROKE_SAMPLES);
    if (samples.length === 0) {
      return;
    }
    for (const { number, place } of stroke.copies) {
      const placed = samples.map(({ position, radius }) => ({ position: withinReach(place(position)), radius }));
      this.#options.submit({ kind: "stroke_move", stroke: number, samples: placed });
    }
  }

  /** The radius under a pressure; no wider than the picture shows around a point. */
  #radius(pressure: number | null, through: Vec3): number {
    const radius = Math.min(this.#options.radius(), this.#options.view.widest(through));
    const share = pressure !== null && this.#options.pressureWidens() ? radiusShare(pressure) : 1;
    return tidy(Math.min(MAX_RADIUS, Math.max(0, radius * share)));
  }
}

function placesOf(copies: readonly Copy[], point: Vec3): readonly Vec3[] {
  return copies.map(({ place }) => withinReach(place(point)));
}
