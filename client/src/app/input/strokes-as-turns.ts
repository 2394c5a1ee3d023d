import type { Gesture, StrokePoint } from "./gesture";

/** Where nobody may draw one finger turns the tree, as three do anywhere; gestures that move the view stay. */
export class StrokesAsTurns {
  #last: StrokePoint | null = null;

  /** What a gesture means to somebody who only looks; null if nothing. */
  seen(gesture: Gesture): Gesture | null {
    switch (gesture.kind) {
      case "stroke-begin":
        this.#last = gesture.point;
        return null;
      case "stroke-move":
        return this.#turn(gesture.points.at(-1));
      case "stroke-end":
        this.#last = null;
        return null;
      case "pan":
      case "orbit":
      case "zoom":
        return gesture;
      default:
        return null;
    }
  }

  #turn(to: StrokePoint | undefined): Gesture | null {
    const from = this.#last;
    if (to === undefined || from === null) {
      return null;
    }
    this.#last = to;
    return { kind: "orbit", dx: to.x - from.x, dy: to.y - from.y };
  }
}
