import { describe, expect, it } from "vitest";
import { kinds, pointers, touch } from "../../../test/pointers";
import { HOLD, PEN_MEMORY, wheelFactor } from "./gesture-recogniser";

describe("one finger", () => {
  it("draws once it has moved, from where it came down", () => {
    const { down, move, up } = pointers();
    expect(down(1, 100, 100, 0)).toEqual([]);
    expect(move(1, 103, 100, 10)).toEqual([]);
    expect(move(1, 120, 100, 20)).toEqual([
      { kind: "stroke-begin", point: touch(100, 100) },
      { kind: "stroke-move", points: [touch(103, 100), touch(120, 100)] },
    ]);
    expect(move(1, 130, 100, 30)).toEqual([{ kind: "stroke-move", points: [touch(130, 100)] }]);
    expect(up(1, 130, 100, 40)).toEqual([{ kind: "stroke-end" }]);
  });

  it("draws where it rests", () => {
    const { recogniser, down } = pointers();
    down(1, 50, 60, 1000);
    expect(recogniser.deadline).toBe(1000 + HOLD);
    expect(recogniser.tick(1000 + HOLD - 1)).toEqual([]);
    expect(recogniser.tick(1000 + HOLD)).toEqual([{ kind: "stroke-begin", point: touch(50, 60) }]);
    expect(recogniser.deadline).toBeNull();
  });

  it("a quick tap is a stroke of one place", () => {
    const { down, up } = pointers();
    down(1, 5, 5, 0);
    expect(kinds(up(1, 5, 5, 30))).toEqual(["stroke-begin", "stroke-end"]);
  });

  it("a tap the system takes away draws nothing", () => {
    const { recogniser, down } = pointers();
    down(1, 5, 5, 0);
    expect(recogniser.cancel(1)).toEqual([]);
    expect(recogniser.tick(1000)).toEqual([]);
  });

  it("a stroke the system takes away ends", () => {
    const { recogniser, down, move } = pointers();
    down(1, 5, 5, 0);
    move(1, 50, 5, 10);
    expect(recogniser.cancel(1)).toEqual([{ kind: "stroke-end" }]);
  });

  it("delivers every coalesced place in order", () => {
    const { recogniser, down, move, at } = pointers();
    down(1, 0, 0, 0);
    move(1, 20, 0, 10);
    const places = [21, 22, 23].map((x) => at(1, x, 0, 20, "touch"));
    expect(recogniser.move(places)).toEqual([
      { kind: "stroke-move", points: [touch(21, 0), touch(22, 0), touch(23, 0)] },
    ]);
  });

  it("later fingers do not disturb a stroke", () => {
    const { down, move, up } = pointers();
    down(1, 0, 0, 0);
    move(1, 40, 0, 20);
    expect(down(2, 200, 200, 200)).toEqual([]);
    expect(move(2, 260, 200, 210)).toEqual([]);
    expect(up(2, 260, 200, 220)).toEqual([]);
    expect(kinds(move(1, 50, 0, 230))).toEqual(["stroke-move"]);
    expect(kinds(up(1, 50, 0, 240))).toEqual(["stroke-end"]);
  });
});

describe("pen and palm", () => {
  it("a pen draws at once and tells its pressure", () => {
    const { down } = pointers();
    expect(down(9, 10, 20, 0, "pen", { pressure: 0.25 })).toEqual([
      { kind: "stroke-begin", point: { x: 10, y: 20, pressure: 0.25 } },
    ]);
  });

  it("a palm beside the pen does nothing", () => {
    const { recogniser, down, move, up } = pointers();
    down(9, 10, 20, 0, "pen");
    expect(down(1, 300, 300, 10)).toEqual([]);
    expect(move(1, 350, 300, 20)).toEqual([]);
    expect(recogniser.tick(500)).toEqual([]);
    expect(kinds(move(9, 30, 20, 510, "pen"))).toEqual(["stroke-move"]);
    expect(up(1, 350, 300, 520)).toEqual([]);
    expect(up(9, 30, 20, 530, "pen")).toEqual([{ kind: "stroke-end" }]);
  });

  it("a palm that came down first gives way to the pen", () => {
    const { recogniser, down, move } = pointers();
    down(1, 300, 300, 0);
    expect(kinds(down(9, 10, 20, 40, "pen"))).toEqual(["stroke-begin"]);
    expect(recogniser.tick(500)).toEqual([]);
    expect(move(1, 400, 300, 60)).toEqual([]);
  });

  it("a palm's stroke ends where the pen's begins", () => {
    const { down, move } = pointers();
    down(1, 300, 300, 0);
    move(1, 340, 300, 20);
    expect(kinds(down(9, 10, 20, 40, "pen"))).toEqual(["stroke-end", "stroke-begin"]);
  });

  it("touches draw again a while after the pen was put away", () => {
    const { recogniser, down, up } = pointers();
    down(9, 10, 20, 0, "pen");
    up(9, 10, 20, 10, "pen");
    down(1, 5, 5, 1000);
    expect(recogniser.tick(1000 + HOLD)).toEqual([]);
    up(1, 5, 5, 1200);
    down(1, 5, 5, PEN_MEMORY + 20);
    expect(kinds(recogniser.tick(PEN_MEMORY + 20 + HOLD))).toEqual(["stroke-begin"]);
  });

  it("two fingers still move the view beside a pen", () => {
    const { down, move, up } = pointers();
    down(9, 10, 20, 0, "pen");
    up(9, 10, 20, 10, "pen");
    down(1, 100, 100, 1000);
    down(2, 200, 100, 1010);
    expect(kinds(move(1, 100, 150, 1020))).toContain("pan");
  });
});

describe("mouse", () => {
  const dragged = (extra: object) => {
    const { down, move, up } = pointers();
    return kinds([...down(1, 0, 0, 0, "mouse", extra), ...move(1, 9, 9, 9, "mouse"), ...up(1, 9, 9, 10, "mouse")]);
  };

  it("the left button draws without delay", () => {
    expect(dragged({ button: 0 })).toEqual(["stroke-begin", "stroke-move", "stroke-end"]);
  });

  it("right rotates, middle pans, shift or space pans", () => {
    expect(dragged({ button: 2 })).toEqual(["orbit"]);
    expect(dragged({ button: 1 })).toEqual(["pan"]);
    expect(dragged({ button: 0, pans: true })).toEqual(["pan"]);
  });

  it("hovering is no gesture", () => {
    expect(pointers().move(1, 40, 40, 5, "mouse")).toEqual([]);
  });

  it("the wheel comes closer upwards, in whatever unit it turns", () => {
    expect(wheelFactor(-100, 0, false)).toBeGreaterThan(1);
    expect(wheelFactor(3, 1, false)).toBeLessThan(1);
    expect(wheelFactor(100, 0, false) * wheelFactor(-100, 0, false)).toBeCloseTo(1);
    expect(wheelFactor(1e9, 0, false)).toBeGreaterThan(0.5);
  });
});
