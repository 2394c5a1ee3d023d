import { describe, expect, it } from "vitest";
import { OutlineTrace } from "./outline-trace";

describe("outline trace", () => {
  it("stays until the tree has grown into it", () => {
    const trace = new OutlineTrace();
    trace.draw([[1, 2]]);
    trace.draw(null);
    expect(trace.shown.value).toBeNull();
    trace.grow([[[0, 0, 0]]], 7);
    trace.done(6);
    expect(trace.shown.value?.stage, "what was asked for before").toBe("growing");
    trace.done(7);
    expect(trace.shown.value).toBeNull();
  });

  it("one that is being drawn does not end with growth", () => {
    const trace = new OutlineTrace();
    trace.grow([[[0, 0, 0]]], 1);
    trace.draw([[5, 5]]);
    trace.done(9);
    expect(trace.shown.value?.stage).toBe("drawing");
  });

  it("shows what was drawn up to then", () => {
    const trace = new OutlineTrace();
    const points: [number, number][] = [[1, 1]];
    trace.draw(points);
    const first = trace.shown.value;
    points.push([2, 2]);
    trace.draw(points);
    expect([first, trace.shown.value]).toMatchObject([
      { stage: "drawing", points: [[1, 1]] },
      {
        stage: "drawing",
        points: [
          [1, 1],
          [2, 2],
        ],
      },
    ]);
  });
});
