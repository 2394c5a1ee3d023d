import type { Gesture } from "../../input/gesture";

/** How far a finger may wander and still tap, in pixels. */
const TAP = 9;

/** One finger on the picture turns it, or taps; two move it as everywhere. */
export class TapOrTurn {
  #stroke: { readonly x: number; readonly y: number; last: readonly [number, number]; moved: boolean } | null = null;

  constructor(readonly tapped: (x: number, y: number) => void) {}

  /** What a gesture still means to the view. */
  gesture(gesture: Gesture): Gesture | null {
    switch (gesture.kind) {
      case "stroke-begin": {
        const { x, y } = gesture.point;
        this.#stroke = { x, y, last: [x, y], moved: false };
        return null;
      }
      case "stroke-move": {
        const [stroke, to] = [this.#stroke, gesture.points.at(-1)];
        if (!stroke || !to) {
          return null;
        }
        stroke.moved ||= Math.hypot(to.x - stroke.x, to.y - stroke.y) > TAP;
        const [dx, dy] = [to.x - stroke.last[0], to.y - stroke.last[1]];
        if (!stroke.moved) {
          return null;
        }
        stroke.last = [to.x, to.y];
        return { kind: "orbit", dx, dy };
      }
      case "stroke-end": {
        const stroke = this.#stroke;
        this.#stroke = null;
        if (stroke && !stroke.moved) {
          this.tapped(stroke.x, stroke.y);
        }
        return null;
      }
      case "pan":
      case "orbit":
      case "zoom":
      case "several-tap":
        return gesture;
      default:
        return null;
    }
  }
}
