import { describe, expect, it } from "vitest";
import { OutlineTrace } from "./outline-trace";

describe("outline trace", () => {
  it("stays until the tree has grown into it", () => {
    const trace = new OutlineTrace();
    trace.draw([[1, 2]]);
    trace.draw(null);
    expect(trace.shown.value).toBeNull();
    trace.grow([[[0, 0, 0]]], 7);
    trace.progressed(6, 0);
    expect(trace.shown.value, "the server does not know of it yet").not.toBeNull();
    trace.progressed(7, 1);
    trace.progressed(9, 3);
    expect(trace.shown.value?.stage).toBe("growing");
    trace.progressed(9, 0);
    expect(trace.shown.value).toBeNull();
  });

  it("one that is being drawn does not end with growth", () => {
    const trace = new OutlineTrace();
    trace.grow([[[0, 0, 0]]], 1);
    trace.draw([[5, 5]]);
    trace.progressed(9, 0);
    expect(trace.shown.value?.stage).toBe("drawing");
  });

  it("quick growth may end before its command is acknowledged", () => {
    const trace = new OutlineTrace();
    trace.progressed(3, 0);
    trace.grow([[[0, 0, 0]]], 4);
    trace.settled(4);
    expect(trace.shown.value?.stage, "no message since").toBe("growing");
    trace.grow([[[0, 0, 0]]], 5);
    trace.progressed(4, 0);
    trace.settled(5);
    expect(trace.shown.value).toBeNull();
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
