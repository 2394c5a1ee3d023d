import { describe, expect, it } from "vitest";
import {
  CHOOSE,
  type Gesture,
  GestureRecogniser,
  HOLD,
  LONGEST_TAP,
  PEN_MEMORY,
  type PointerSample,
  SECOND_TAP,
  wheelFactor,
} from "./gesture-recogniser";

type Device = PointerSample["device"];

function pointers() {
  const recogniser = new GestureRecogniser();
  const at = (id: number, x: number, y: number, time: number, device: Device, pressure = 0.5) => ({
    id,
    x,
    y,
    time,
    device,
    pressure,
  });
  return {
    recogniser,
    down: (id: number, x: number, y: number, time: number, device: Device = "touch", extra: object = {}) =>
      recogniser.down({
        ...at(id, x, y, time, device),
        button: 0,
        pans: false,
        choose: false,
        holdable: false,
        ...extra,
      }),
    move: (id: number, x: number, y: number, time: number, device: Device = "touch") =>
      recogniser.move([at(id, x, y, time, device)]),
    up: (id: number, x: number, y: number, time: number, device: Device = "touch") =>
      recogniser.up(at(id, x, y, time, device)),
    at,
  };
}

const kinds = (gestures: Gesture[]) => gestures.map(({ kind }) => kind);
const touch = (x: number, y: number) => ({ x, y, pressure: null });

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

describe("a tool that takes hold", () => {
  const take = { grip: "take" };

  it("gets each finger by itself, from the first place on", () => {
    const { recogniser, down, move, up } = pointers();
    expect(down(1, 5, 5, 0, "touch", take)).toMatchObject([{ kind: "grip-begin", id: 1, x: 5, y: 5 }]);
    expect(recogniser.deadline, "nothing waits").toBeNull();
    expect(kinds(down(2, 90, 5, 10, "touch", take))).toEqual(["grip-begin"]);
    expect(move(2, 95, 5, 20)).toEqual([{ kind: "grip-move", id: 2, x: 95, y: 5 }]);
    expect([...up(1, 5, 5, 30), ...up(2, 95, 5, 40)]).toEqual([
      { kind: "grip-end", id: 1 },
      { kind: "grip-end", id: 2 },
    ]);
    expect(kinds(down(3, 5, 5, 50, "touch", take))).toEqual(["grip-begin"]);
  });

  it("leaves its fingers to the view when one more does not fit", () => {
    const { down, move, up } = pointers();
    down(1, 100, 100, 0, "touch", take);
    expect(kinds(down(2, 200, 100, 10, "touch", { grip: "leave" }))).toEqual(["grip-drop"]);
    expect(kinds(move(2, 300, 100, 20))).toEqual(["pan", "zoom"]);
    expect([...up(1, 100, 100, 30), ...up(2, 300, 100, 40)]).toEqual([]);
  });

  it("a finger that is ignored changes nothing, also when it stays last", () => {
    const { down, move, up } = pointers();
    down(1, 100, 100, 0, "touch", take);
    expect(down(2, 200, 100, 10, "touch", { grip: "ignore" })).toEqual([]);
    expect(move(2, 300, 100, 20)).toEqual([]);
    expect(kinds(up(1, 100, 100, 30))).toEqual(["grip-end"]);
    expect([...move(2, 350, 100, 40), ...up(2, 350, 100, 50)]).toEqual([]);
    expect(kinds(down(3, 5, 5, 60, "touch", take))).toEqual(["grip-begin"]);
  });

  it("a pen takes hold while a palm rests", () => {
    const { down, move, up } = pointers();
    down(1, 300, 300, 0, "touch", take);
    expect(kinds(down(9, 10, 20, 40, "pen", take))).toEqual(["grip-drop", "grip-begin"]);
    expect(down(2, 320, 300, 50, "touch", take)).toEqual([]);
    expect(kinds(move(9, 30, 20, 60, "pen"))).toEqual(["grip-move"]);
    expect(kinds(up(9, 30, 20, 70, "pen"))).toEqual(["grip-end"]);
  });

  it("one that the system takes away is let go of", () => {
    const { recogniser, down } = pointers();
    down(1, 5, 5, 0, "touch", take);
    expect(kinds(recogniser.cancel(1))).toEqual(["grip-end"]);
  });
});

describe("several fingers", () => {
  it("a second finger makes a starting stroke a pan", () => {
    const { recogniser, down, move } = pointers();
    down(1, 100, 100, 0);
    move(1, 102, 100, 20);
    expect(down(2, 200, 100, 60)).toEqual([]);
    expect(recogniser.tick(500)).toEqual([]);
    const moved = [...move(1, 112, 110, 70), ...move(2, 210, 110, 70)];
    expect(kinds(moved)).not.toContain("stroke-begin");
    const pans = moved.filter((gesture) => gesture.kind === "pan");
    expect(pans.reduce((sum, { dx }) => sum + dx, 0)).toBeCloseTo(10);
    expect(pans.reduce((sum, { dy }) => sum + dy, 0)).toBeCloseTo(10);
  });

  it("pinching zooms about the middle", () => {
    const { down, move } = pointers();
    down(1, 100, 100, 0);
    down(2, 200, 100, 10);
    const [, zoom] = move(2, 300, 100, 20);
    expect(zoom).toEqual({ kind: "zoom", factor: 2, x: 200, y: 100 });
  });

  it("a whole pinch multiplies to the ratio of distances", () => {
    const { down, move } = pointers();
    down(1, 150, 100, 0);
    down(2, 250, 100, 10);
    let factor = 1;
    for (let i = 1; i <= 20; i++) {
      for (const gesture of [...move(1, 150 - i * 5, 100, 10 + i), ...move(2, 250 + i * 5, 100, 10 + i)]) {
        factor *= gesture.kind === "zoom" ? gesture.factor : 1;
      }
    }
    expect(factor).toBeCloseTo(3);
  });

  it("three fingers rotate by the way of their middle", () => {
    const { down, move } = pointers();
    [1, 2, 3].map((id) => down(id, id * 50, 100, id));
    const turned = [1, 2, 3].flatMap((id) => move(id, id * 50 + 30, 100, 20));
    expect(kinds(turned)).toEqual(["orbit", "orbit", "orbit"]);
    expect(turned.reduce((sum, gesture) => sum + (gesture.kind === "orbit" ? gesture.dx : 0), 0)).toBeCloseTo(30);
  });

  it("lifting one of three does not jerk the view", () => {
    const { down, move, up } = pointers();
    [1, 2, 3].map((id) => down(id, id * 50, 100, id));
    up(3, 150, 100, 50);
    expect(move(1, 0, 0, 60)).toEqual([]);
  });

  it("the last finger of a pinch does not draw", () => {
    const { recogniser, down, move, up } = pointers();
    down(1, 100, 100, 0);
    down(2, 200, 100, 10);
    up(2, 200, 100, 50);
    expect(move(1, 300, 300, 500)).toEqual([]);
    expect(recogniser.tick(1000)).toEqual([]);
    expect(up(1, 300, 300, 600)).toEqual([]);
    down(3, 10, 10, 700);
    expect(kinds(move(3, 60, 10, 720))).toEqual(["stroke-begin", "stroke-move"]);
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

describe("a tap of several fingers", () => {
  const several = (fingers: number) => [{ kind: "several-tap", fingers }];

  it("is one gesture once all are up, however they tremble", () => {
    const { recogniser, down, move, up } = pointers();
    down(1, 100, 100, 0);
    down(2, 200, 100, 30);
    expect(move(1, 104, 103, 60)).toEqual([]);
    expect(up(2, 200, 100, 120)).toEqual([]);
    // What a browser says of the capture of a finger that has lifted.
    expect(recogniser.cancel(2)).toEqual([]);
    expect(up(1, 104, 103, 150)).toEqual(several(2));
    down(3, 100, 100, 1000);
    down(4, 200, 100, 1010);
    down(5, 300, 100, 1020);
    expect([...up(3, 100, 100, 1100), ...up(5, 300, 100, 1110), ...up(4, 200, 100, 1120)]).toEqual(several(3));
  });

  it("is none after a pan, a pinch or a long touch, which lose nothing of their way", () => {
    const { down, move, up } = pointers();
    down(1, 100, 100, 0);
    down(2, 200, 100, 10);
    expect(move(2, 205, 100, 20)).toEqual([]);
    expect(move(2, 220, 100, 30)).toMatchObject([{ kind: "pan", dx: 10 }, { kind: "zoom" }]);
    expect([...up(1, 100, 100, 60), ...up(2, 220, 100, 80)]).toEqual([]);
    down(1, 100, 100, 1000);
    down(2, 200, 100, 1010);
    expect(move(2, 206, 100, 2000), "a slow one has its way as well").toMatchObject([{ dx: 3 }, { kind: "zoom" }]);
    expect([...up(1, 100, 100, 2010), ...up(2, 206, 100, 2020)]).toEqual([]);
  });

  it("is none where a finger drew, a tool took one, or the system took one away", () => {
    const { recogniser, down, move, up } = pointers();
    down(1, 100, 100, 0);
    move(1, 130, 100, 20);
    down(2, 200, 100, 30);
    expect([...kinds(up(2, 200, 100, 60)), ...kinds(up(1, 130, 100, 80))]).toEqual(["stroke-end"]);
    down(1, 100, 100, 1000, "touch", { grip: "take" });
    down(2, 200, 100, 1010, "touch", { grip: "ignore" });
    expect(kinds([...up(1, 100, 100, 1050), ...up(2, 200, 100, 1060)])).toEqual(["grip-end"]);
    down(1, 100, 100, 2000);
    down(2, 200, 100, 2010);
    expect([...recogniser.cancel(2), ...up(1, 100, 100, 2060)]).toEqual([]);
  });

  it("is one with a tool that lets both go", () => {
    const { down, up } = pointers();
    down(1, 100, 100, 0, "touch", { grip: "take" });
    down(2, 200, 100, 10, "touch", { grip: "leave" });
    expect([...up(1, 100, 100, 60), ...up(2, 200, 100, 70)]).toEqual(several(2));
  });
});
