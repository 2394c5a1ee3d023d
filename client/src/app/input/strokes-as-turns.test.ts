import { expect, it } from "vitest";
import type { Gesture } from "./gesture";
import { StrokesAsTurns } from "./strokes-as-turns";

const at = (x: number, y: number) => ({ x, y, pressure: null });

it("turns the tree by as much as a finger moves, and does nothing else with it", () => {
  const turns = new StrokesAsTurns();
  const seen = (gesture: Gesture) => turns.seen(gesture);
  expect(seen({ kind: "stroke-move", points: [at(1, 1)] })).toBeNull();
  expect(seen({ kind: "stroke-begin", point: at(10, 10) })).toBeNull();
  expect(seen({ kind: "stroke-move", points: [at(12, 11), at(15, 8)] })).toEqual({ kind: "orbit", dx: 5, dy: -2 });
  expect(seen({ kind: "stroke-move", points: [at(15, 9)] })).toEqual({ kind: "orbit", dx: 0, dy: 1 });
  expect(seen({ kind: "stroke-end" })).toBeNull();
  expect(seen({ kind: "stroke-move", points: [at(1, 1)] })).toBeNull();
});

it("leaves alone what moves the view, and takes what would change the tree", () => {
  const turns = new StrokesAsTurns();
  const zoom: Gesture = { kind: "zoom", factor: 2, x: 1, y: 1 };
  expect(turns.seen(zoom)).toBe(zoom);
  expect(turns.seen({ kind: "double-tap", x: 1, y: 1 })).toBeNull();
  expect(turns.seen({ kind: "several-tap", fingers: 2 })).toBeNull();
});
