import type { Resume } from "../wire/generated";

/** A place in the world, in internodes. */
export type Point = readonly [number, number, number];

/** What the tools need of the view; `scene/viewport.ts` provides it. */
export interface BrushView {
  /** Where the ray through a pixel meets the plane parallel to the screen through a point. */
  pointOnPlane(x: number, y: number, through: Point): Point | null;
  /** The branch nearest to a pixel, within a tolerance in pixels. */
  pick(x: number, y: number, tolerance: number): { readonly row: number; readonly point: Point } | null;
  showBrush(point: Point, radius: number): void;
  hideBrush(): void;
}

/** What the connection needs of the rows the server has sent; `scene/table/tree-table.ts` provides it. */
export interface RowStore<Frame> {
  /** What is held, if anything, for a resume (`RS1`). */
  held(): Resume | undefined;
  /** Takes in a frame; throws where it does not fit what is held. */
  apply(frame: Frame): void;
  /** Forgets every row. */
  clear(): void;
}
