/** One pointer event, reduced to what gestures are made of. Positions are in pixels of the canvas. */
export interface PointerSample {
  readonly id: number;
  readonly device: "touch" | "pen" | "mouse";
  readonly x: number;
  readonly y: number;
  readonly pressure: number;
  /** In milliseconds, of the same clock for all calls. */
  readonly time: number;
}

export interface PointerPress extends PointerSample {
  readonly button: number;
  /** Shift or the space bar is held: the pointer pans instead of drawing. */
  readonly pans: boolean;
  /** The alt key is held: a press chooses what is there, with no wait. */
  readonly choose: boolean;
  /** Holding still here chooses something. */
  readonly holdable: boolean;
  /** Two taps mean something here, so that a tap has to wait for a second one; or nothing, but may not draw. */
  readonly doubles?: boolean;
  /** What the chosen tool does with a finger that comes down here; without one it draws strokes. */
  readonly grip?: Grip;
}

/**
 * What a tool that takes hold of things does with one more finger: takes it, leaves it and all it has taken to moving
 * the view, or lets it rest where it is.
 */
export type Grip = "take" | "leave" | "ignore";

/** A place a stroke went through. */
export interface StrokePoint {
  readonly x: number;
  readonly y: number;
  /** 0 to 1; only a pen knows, others say null. */
  readonly pressure: number | null;
}

export type Gesture =
  | { readonly kind: "stroke-begin"; readonly point: StrokePoint }
  | { readonly kind: "stroke-move"; readonly points: readonly StrokePoint[] }
  | { readonly kind: "stroke-end" }
  /** One is held still where that chooses something; it does so after `milliseconds` more. */
  | { readonly kind: "hold-begin"; readonly x: number; readonly y: number; readonly milliseconds: number }
  /** It was let go, or has moved on. */
  | { readonly kind: "hold-end" }
  | { readonly kind: "choose"; readonly x: number; readonly y: number }
  | { readonly kind: "double-tap"; readonly x: number; readonly y: number }
  /** So many fingers tapped at once, and did nothing else. */
  | { readonly kind: "several-tap"; readonly fingers: number }
  /** A tool's finger comes down, moves, lifts; `slop` is how far it may wander and still be a tap. */
  | { readonly kind: "grip-begin"; readonly id: number; readonly x: number; readonly y: number; readonly slop: number }
  | { readonly kind: "grip-move"; readonly id: number; readonly x: number; readonly y: number }
  | { readonly kind: "grip-end"; readonly id: number }
  /** The fingers that were taken move the view after all. */
  | { readonly kind: "grip-drop" }
  | { readonly kind: "pan"; readonly dx: number; readonly dy: number }
  | { readonly kind: "orbit"; readonly dx: number; readonly dy: number }
  | { readonly kind: "zoom"; readonly factor: number; readonly x: number; readonly y: number };
