/** Things on the page that are no panel, sheet or tool, and can be pointed at. */
export type PlaceName =
  | "undo"
  | "fit"
  | "size"
  | "grow"
  | "radius"
  | "rotation"
  | "timeline"
  | "draw-modes"
  | "hide"
  | "new";
