import { describe, expect, it } from "vitest";
import { OutlineTrace } from "./outline-trace";

describe("outline trace", () => {
  it("stays until the tree has grown into it", () => {
    const trace = new OutlineTrace();
    trace.draw([[1, 2]]);
    trace.draw(null);
    expect(trace.shown.value).toBeNull();
    trace.grow([[0, 0, 0]], 7);
    trace.told(6, 0);
    expect(trace.shown.value, "the server does not know of it yet").not.toBeNull();
    trace.told(7, 1);
    trace.told(9, 3);
    expect(trace.shown.value?.stage).toBe("growing");
    trace.told(9, 0);
    expect(trace.shown.value).toBeNull();
  });

  it("one that is being drawn does not end with growth", () => {
    const trace = new OutlineTrace();
    trace.grow([[0, 0, 0]], 1);
    trace.draw([[5, 5]]);
    trace.told(9, 0);
    expect(trace.shown.value?.stage).toBe("drawing");
  });

  it("quick growth may be told of before its command is acknowledged", () => {
    const trace = new OutlineTrace();
    trace.told(3, 0);
    trace.grow([[0, 0, 0]], 4);
    trace.settled(4);
    expect(trace.shown.value?.stage, "nothing was told since").toBe("growing");
    trace.grow([[0, 0, 0]], 5);
    trace.told(4, 0);
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
    expect([first, trace.shown.value]).toEqual([
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
