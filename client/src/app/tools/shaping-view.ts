import type { Guise } from "../../scene/overlay/overlays";
import type { Vec3 } from "../../scene/vector";

/** What shaping a branch by hand needs of the view. */
export interface ShapingView {
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  pick(x: number, y: number, tolerance: number): { readonly row: number; readonly point: Vec3 } | null;
  /** Where a row is drawn. */
  placeOf(row: number): Vec3;
  wear(guise: Guise): void;
  doff(guise: Guise): void;
  wears(guise: Guise): boolean;
  guiseChanged(): void;
}
