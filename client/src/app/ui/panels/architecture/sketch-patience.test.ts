import { expect, it } from "vitest";
import { sketchState } from "./sketch-patience";

it("a sketch that a busy server is late with is growing, and not lost", () => {
  expect([0, 1, 2].map((unanswered) => sketchState(false, unanswered))).toEqual(["growing", "growing", "growing"]);
});

it("one that was grown stays, until no newer one can be had", () => {
  expect([0, 1, 2, 3].map((unanswered) => sketchState(true, unanswered))).toEqual([
    "grown",
    "grown",
    "grown",
    "failed",
  ]);
  expect(sketchState(false, 3)).toBe("failed");
});
