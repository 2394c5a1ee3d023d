import type { Pick as Picked } from "../../scene/camera/picking";
import type { Air } from "../../scene/motion/air";
import type { Overlay } from "../../scene/overlay/overlays";
import type { Vec3 } from "../../scene/vector";

/** What the wind has to know of shaping. */
export type Wind = Pick<Air, "release" | "cut" | "sways">;

/** The part of the view that the shaping tools use. */
export interface ShapingView {
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  pick(x: number, y: number, tolerance: number): Picked | null;
  /** Where a row is seen. */
  seenAt(row: number): Vec3;
  /** What moves the tree; null where no wind has blown. */
  readonly air: Wind | null;
  addOverlay(overlay: Overlay): void;
  removeOverlay(overlay: Overlay): void;
  hasOverlay(overlay: Overlay): boolean;
  overlayChanged(): void;
}
