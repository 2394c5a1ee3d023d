import type { Overlay } from "../../scene/overlay/overlays";
import type { Vec3 } from "../../scene/vector";

/** The part of the view that the shaping tools use. */
export interface ShapingView {
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  pick(x: number, y: number, tolerance: number): { readonly row: number; readonly point: Vec3 } | null;
  /** Where a row is drawn. */
  placeOf(row: number): Vec3;
  addOverlay(overlay: Overlay): void;
  removeOverlay(overlay: Overlay): void;
  hasOverlay(overlay: Overlay): boolean;
  overlayChanged(): void;
}
