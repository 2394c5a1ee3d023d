import { describe, expect, it } from "vitest";
import { kinds, pointers } from "../../../test/pointers";

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
