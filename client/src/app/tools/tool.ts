import type { ReadonlySignal } from "@preact/signals";
import type { Vec3 } from "../../scene/vector";
import { type Command, FARTHEST } from "../../wire/generated";
import type { Grip, StrokePoint } from "../input/gesture-recogniser";

/** A tool that works on the tree with fingers, a pen or the left mouse button. */
export interface Tool {
  /** What is in progress ends where it is. */
  end(): void;
  /** Forgets what is in progress: nothing more of it is sent. */
  abandon(): void;
  /** Takes back what is in progress, where that is more than forgetting it. */
  cancel?(): void;
  /** Called again and again while something is in progress. */
  tick?(): void;
  /** A mouse or pen is over the canvas and not down. */
  hover?(x: number, y: number): void;
  /** It is there no longer. */
  leave?(): void;
  /** Rows have changed, or commands were answered. */
  changed?(): void;
  /** The server would not do a command: what was shown of it is as it was. */
  refused?(command: Command): void;
  /** The wheel turns by a factor; false if the tool has no use for it. */
  zoom?(factor: number): boolean;
  /** Cuts off the branches at some rows, or the one at a place; false where there is none. */
  cut?(rows: readonly number[]): void;
  /** Marks the branches that `cut` would take off at some rows until others are marked; gives where they begin, and at how many of the rows nothing can be cut. */
  mark?(rows: readonly number[]): { readonly cuts: readonly number[]; readonly kept: number };
  cutAt?(x: number, y: number): boolean;
  /** Where it would put something into the scene; null for nowhere. */
  readonly coming?: ReadonlySignal<Vec3 | null>;
  /** What it has asked the server to put there, by the numbers of commands; some of it may be there already. */
  readonly planted?: ReadonlySignal<readonly { readonly place: Vec3; readonly command: number }[]>;
  /** Releases what is marked, as Escape does while nothing is in progress; false if there was nothing. */
  release?(): boolean;
}

/** One that draws strokes. */
export interface StrokeTool extends Tool {
  begin(point: StrokePoint): void;
  move(points: readonly StrokePoint[]): void;
}

/** One that takes hold of places with several fingers at once, or with one pointer. */
export interface GripTool extends Tool {
  /** What it does with one more finger here. */
  takes(x: number, y: number): Grip;
  /** `slop` is how far the finger may wander and still be a tap, in pixels. */
  gripBegin(id: number, x: number, y: number, slop: number): void;
  gripMove(id: number, x: number, y: number): void;
  gripEnd(id: number): void;
  /** The fingers move the view after all. */
  gripDrop(): void;
}

/** How near to a branch a stroke must begin to begin on it, in pixels. */
export const PICK_TOLERANCE = 24;

/** The nearest place the server accepts; nothing grows below the ground. */
export function withinReach([x, y, z]: readonly [number, number, number]): [number, number, number] {
  const clamp = (value: number, least: number) => tidy(Math.min(FARTHEST, Math.max(least, value)));
  return [clamp(x, -FARTHEST), clamp(y, 0), clamp(z, -FARTHEST)];
}

/** A thousandth of an internode is far below what anyone can see, and the message is half as long. */
export function tidy(value: number): number {
  return Math.round(value * 1000) / 1000;
}
