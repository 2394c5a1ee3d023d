import type { Vec3 } from "../../scene/vector";

/** What the tools need of the view; `scene/viewport.ts` provides it. */
export interface BrushView {
  /** Where the ray through a pixel meets the plane parallel to the screen through a point. */
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null;
  /** The branch nearest to a pixel, within a tolerance in pixels. */
  pick(x: number, y: number, tolerance: number): { readonly row: number; readonly point: Vec3 } | null;
  /** The radius of the widest brush around a point that stays in the picture. */
  widest(point: Vec3): number;
  /** Shows the brush at one or more places. */
  showBrush(points: readonly Vec3[], radius: number): void;
  hideBrush(): void;
}
