import type { Guise } from "../../scene/guise/guises";
import type { Point } from "../ports";

/** What shaping a branch by hand needs of the view. */
export interface ShapingView {
  pointOnPlane(x: number, y: number, through: Point): Point | null;
  pick(x: number, y: number, tolerance: number): { readonly row: number; readonly point: Point } | null;
  /** Where a row is drawn. */
  placeOf(row: number): Point;
  wear(guise: Guise): void;
  doff(guise: Guise): void;
  wears(guise: Guise): boolean;
  guiseChanged(): void;
}
