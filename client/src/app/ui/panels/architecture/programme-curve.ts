import type { Programme } from "../../../../wire/generated";
import { type NumberParameter, patchFor } from "../../../document/growth/growth-parameters";
import { type Change, changesOf, valuesAt, withChanges } from "../../../document/growth/programme-control";
import { onStep } from "../../../words/number-text";
import { placeOf, valueAt } from "../../controls/travel";
import { clamped, type Place, short } from "./place";

/** A point of the curve: from this age on the parameter has this value. */
export interface Point {
  readonly age: number;
  readonly value: number;
  /** Which of the programme's changes it is; null for what it begins with. */
  readonly change: number | null;
}

/** The course of a number over age. */
export function pointsOf(programme: Programme, { name }: NumberParameter): readonly Point[] {
  const changes = changesOf(programme);
  const points = changes.map(({ age }, change) => ({ age, value: valuesAt(programme, age)[name], change }));
  return points[0]?.age === 0
    ? points
    : [{ age: 0, value: { ...valuesAt(programme, -1) }[name], change: null }, ...points];
}

/** The programme with a point somewhere else: between its neighbours, within the parameter's range. */
export function withPoint(
  programme: Programme,
  parameter: NumberParameter,
  change: number | null,
  to: { readonly age: number; readonly value: number },
): Programme {
  const { name, least, most, step } = parameter;
  const value = onStep(to.value, least, most, step);
  if (change === null) {
    const patch = patchFor(name, value, valuesAt(programme, -1));
    return { ...programme, parameters: { ...programme.parameters, ...patch } };
  }
  const changes = changesOf(programme);
  const moved = changes[change];
  if (moved === undefined) {
    return programme;
  }
  const [before, behind] = [changes[change - 1]?.age ?? -1, changes[change + 1]?.age ?? Number.POSITIVE_INFINITY];
  const age = clamped(Math.round(to.age), before + 1, Math.max(before + 1, behind - 1));
  const patch = patchFor(name, value, valuesAt(programme, moved.age));
  const next: Change = { ...moved, age, parameters: { ...moved.parameters, ...patch } };
  return withChanges(programme, changes.with(change, next));
}

/** The programme with one more change, at an age; the same one where there is one. */
export function withChangeAt(programme: Programme, age: number): Programme {
  const changes = changesOf(programme);
  if (changes.some((change) => change.age === age)) {
    return programme;
  }
  const before = changes.findLast((change) => change.age < age);
  const added: Change = { kind: "change", age, parameters: { ...before?.parameters } };
  return withChanges(
    programme,
    [...changes, added].sort((a, b) => a.age - b.age),
  );
}

/** The programme without one of its changes. */
export function withoutChange(programme: Programme, change: number): Programme {
  return withChanges(programme, changesOf(programme).toSpliced(change, 1));
}

/** How far apart the middles of two grips are at least, in pixels: about what a finger covers. */
const APART = 48;

/** The points that have a grip: the chosen one, and in order of age those far enough from all before. */
export function grippable(points: readonly Point[], chosen: Point, scale: CurveScale): readonly Point[] {
  const kept = [chosen];
  for (const point of points) {
    const { x, y } = scale.place(point);
    const isFree = kept.every((other) => {
      const at = scale.place(other);
      return Math.max(Math.abs(at.x - x), Math.abs(at.y - y)) >= APART;
    });
    if (isFree) kept.push(point);
  }
  return kept;
}

/** Where ages and values lie in a diagram. */
export class CurveScale {
  #parameter: NumberParameter;
  #lastAge: number;
  #box: { readonly left: number; readonly top: number; readonly width: number; readonly height: number };

  constructor(
    parameter: NumberParameter,
    lastAge: number,
    box: { readonly left: number; readonly top: number; readonly width: number; readonly height: number },
  ) {
    this.#parameter = parameter;
    this.#lastAge = Math.max(1, lastAge);
    this.#box = box;
  }

  x(age: number): number {
    return this.#box.left + (this.#box.width * Math.min(age, this.#lastAge)) / this.#lastAge;
  }

  /** A value is as high here as it is far on its slider: values that do little get little room. */
  y(value: number): number {
    return this.#box.top + this.#box.height * (1 - placeOf(this.#parameter, value));
  }

  place({ age, value }: Point): Place {
    return { x: this.x(age), y: this.y(value) };
  }

  /** The age and the value at a place. */
  at({ x, y }: Place): { readonly age: number; readonly value: number } {
    const { left, top, width, height } = this.#box;
    return {
      age: ((x - left) / width) * this.#lastAge,
      value: valueAt(this.#parameter, 1 - (y - top) / height),
    };
  }

  /** A line that keeps each value until the next point. */
  path(points: readonly Point[]): string {
    const [first, ...rest] = points.map((point) => this.place(point));
    const steps = rest.map(({ x, y }) => `H${short(x)}V${short(y)}`).join("");
    return first ? `M${short(first.x)} ${short(first.y)}${steps}H${short(this.x(this.#lastAge))}` : "";
  }
}
