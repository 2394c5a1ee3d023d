import { describe, expect, it } from "vitest";
import { kinds, pointers, touch } from "../../../test/pointers";
import { CHOOSE, HOLD, LONGEST_TAP, SECOND_TAP } from "./gesture-recogniser";

describe("holding on a branch", () => {
  const branch = { holdable: true };

  it("a ring fills, then the branch is chosen", () => {
    const { recogniser, down, move, up } = pointers();
    expect(down(1, 50, 60, 1000, "touch", branch)).toEqual([]);
    expect(recogniser.deadline).toBe(1000 + HOLD);
    expect(recogniser.tick(1000 + HOLD)).toEqual([{ kind: "hold-begin", x: 50, y: 60, milliseconds: CHOOSE - HOLD }]);
    expect(recogniser.deadline).toBe(1000 + CHOOSE);
    expect(move(1, 53, 61, 1300)).toEqual([]);
    expect(recogniser.tick(1000 + CHOOSE)).toEqual([{ kind: "hold-end" }, { kind: "choose", x: 50, y: 60 }]);
    expect(recogniser.deadline).toBeNull();
    expect([...move(1, 200, 60, 1600), ...up(1, 200, 60, 1700)], "a chosen branch is not drawn on").toEqual([]);
    expect(kinds([...down(1, 5, 5, 3000), ...up(1, 5, 5, 3020)])).toEqual(["stroke-begin", "stroke-end"]);
  });

  it("one that moves on draws, with all it went through", () => {
    const { recogniser, down, move } = pointers();
    down(1, 0, 0, 0, "touch", branch);
    recogniser.tick(HOLD);
    expect(move(1, 3, 0, 200)).toEqual([]);
    expect(move(1, 30, 0, 210)).toEqual([
      { kind: "hold-end" },
      { kind: "stroke-begin", point: touch(0, 0) },
      { kind: "stroke-move", points: [touch(3, 0), touch(30, 0)] },
    ]);
    expect(recogniser.tick(CHOOSE)).toEqual([]);
  });

  it("a quick tap still draws, a slow one neither draws nor chooses", () => {
    const { recogniser, down, up } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    expect(kinds(up(1, 5, 5, 60))).toEqual(["stroke-begin", "stroke-end"]);
    down(1, 5, 5, 1000, "touch", branch);
    recogniser.tick(1000 + HOLD);
    expect(kinds(up(1, 5, 5, 1300))).toEqual(["hold-end"]);
  });

  it("a second finger turns it into a pinch", () => {
    const { recogniser, down, move } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    recogniser.tick(HOLD);
    expect(kinds(down(2, 90, 90, 200))).toEqual(["hold-end"]);
    expect(recogniser.tick(CHOOSE)).toEqual([]);
    expect(kinds(move(1, 15, 15, 500))).toEqual(["pan", "zoom"]);
  });

  it("one the system takes away chooses nothing", () => {
    const { recogniser, down } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    recogniser.tick(HOLD);
    expect(kinds(recogniser.cancel(1))).toEqual(["hold-end"]);
    expect(recogniser.tick(CHOOSE)).toEqual([]);
  });

  it("a mouse and a pen hold as well", () => {
    for (const device of ["mouse", "pen"] as const) {
      const { recogniser, down, move, up } = pointers();
      expect(down(1, 5, 5, 0, device, branch)).toEqual([]);
      expect(kinds(recogniser.tick(CHOOSE + 5)), device).toEqual(["choose"]);
      expect([...move(1, 90, 5, 600, device), ...up(1, 90, 5, 700, device)]).toEqual([]);
      down(1, 5, 5, 1000, device, branch);
      expect(kinds(move(1, 12, 5, 1020, device)), "a stroke from the branch").toEqual(["stroke-begin", "stroke-move"]);
      expect(kinds(up(1, 12, 5, 1030, device))).toEqual(["stroke-end"]);
    }
  });

  it("a palm beside a pen that is held changes nothing", () => {
    const { recogniser, down } = pointers();
    down(1, 5, 5, 0, "pen", branch);
    expect(down(2, 300, 300, 50)).toEqual([]);
    expect(kinds(recogniser.tick(CHOOSE))).toEqual(["choose"]);
  });

  it("a mouse with the alt key chooses at once", () => {
    const { down, up } = pointers();
    expect(down(1, 7, 8, 0, "mouse", { choose: true })).toEqual([{ kind: "choose", x: 7, y: 8 }]);
    expect(up(1, 7, 8, 20, "mouse")).toEqual([]);
  });
});

describe("two taps", () => {
  const branch = { holdable: true, doubles: true };
  const nothing = { doubles: true };

  it("a double tap on a branch is one gesture and draws nothing", () => {
    const { recogniser, down, up } = pointers();
    down(1, 50, 60, 0, "touch", branch);
    expect(up(1, 50, 60, 60)).toEqual([]);
    down(2, 54, 63, 200, "touch", branch);
    expect(up(2, 54, 63, 260)).toEqual([{ kind: "double-tap", x: 54, y: 63 }]);
    expect([recogniser.deadline, ...recogniser.tick(5000)]).toEqual([null]);
  });

  it("a double tap beside every branch does nothing", () => {
    const { recogniser, down, up } = pointers();
    down(1, 50, 60, 0, "touch", nothing);
    up(1, 50, 60, 60);
    down(2, 52, 60, 200, "touch", nothing);
    expect(up(2, 52, 60, 260)).toEqual([]);
    expect(recogniser.tick(5000)).toEqual([]);
  });

  it("a tap that stays alone draws when no second one can come", () => {
    const { recogniser, down, up } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    up(1, 5, 5, 60);
    expect(recogniser.deadline).toBe(60 + SECOND_TAP);
    expect(recogniser.tick(60 + SECOND_TAP - 1)).toEqual([]);
    expect(kinds(recogniser.tick(60 + SECOND_TAP))).toEqual(["stroke-begin", "stroke-end"]);
  });

  it("slow taps count as well, until they are holds", () => {
    const { recogniser, down, up } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    recogniser.tick(HOLD);
    expect(kinds(up(1, 5, 5, LONGEST_TAP))).toEqual(["hold-end"]);
    down(2, 5, 5, LONGEST_TAP + 100, "touch", branch);
    expect(kinds(up(2, 5, 5, LONGEST_TAP + 200))).toEqual(["double-tap"]);
    down(3, 5, 5, 2000, "touch", branch);
    recogniser.tick(2000 + HOLD);
    expect(kinds(up(3, 5, 5, 2000 + LONGEST_TAP + 1))).toEqual(["hold-end"]);
    expect(recogniser.tick(5000), "a long one draws nothing, not even later").toEqual([]);
  });

  it("a tap far from the first one is another tap", () => {
    const { recogniser, down, up } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    up(1, 5, 5, 60);
    expect(kinds(down(2, 90, 5, 150, "touch", branch))).toEqual(["stroke-begin", "stroke-end"]);
    expect(up(2, 90, 5, 200)).toEqual([]);
    expect(kinds(recogniser.tick(1000))).toEqual(["stroke-begin", "stroke-end"]);
  });

  it("a tap and then a stroke from the same place are both drawn", () => {
    const { down, move, up } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    up(1, 5, 5, 60);
    down(2, 6, 5, 180, "touch", branch);
    const drawn = kinds(move(2, 60, 5, 200));
    expect(drawn).toEqual(["stroke-begin", "stroke-end", "stroke-begin", "stroke-move"]);
  });

  it("a tap and then a pinch: the tap is drawn, the pinch moves the view", () => {
    const { down, move, up } = pointers();
    down(1, 5, 5, 0, "touch", branch);
    up(1, 5, 5, 60);
    down(2, 6, 5, 180, "touch", branch);
    expect(kinds(down(3, 90, 5, 190, "touch", branch))).toEqual(["stroke-begin", "stroke-end"]);
    expect(kinds(move(3, 120, 5, 200))).toEqual(["pan", "zoom"]);
  });

  it("a mouse clicks twice on a branch", () => {
    const { down, up } = pointers();
    down(1, 5, 5, 0, "mouse", branch);
    up(1, 5, 5, 60, "mouse");
    down(1, 5, 5, 150, "mouse", branch);
    expect(kinds(up(1, 5, 5, 210, "mouse"))).toEqual(["double-tap"]);
  });
});
