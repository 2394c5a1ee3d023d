import { describe, expect, it } from "vitest";
import { domeOf } from "./sun-dome";

const PHONE = { left: 10, top: 20, width: 390, height: 460 };
const BAR = { left: 18, top: 120, width: 108, height: 240 };
const shown = (right: number, up: number) => ({ right, up, before: true });

describe("the dome around the tree", () => {
  it("stands around the middle of the workspace, a little below", () => {
    const dome = domeOf(PHONE, null);
    const [x, y] = dome.pixels(shown(0, 0));
    expect([x, y]).toEqual([195, 230 + 0.06 * 460]);
    expect(dome.pixels(shown(0.5, 0.5))).toEqual([x + 78, y - 78]);
  });

  it("a finger points at what is drawn under it", () => {
    const dome = domeOf(PHONE, BAR);
    const [x, y] = dome.pixels(shown(0.4, -0.3));
    const [right, up] = dome.place(PHONE.left + x, PHONE.top + y);
    expect([right, up].map((value) => Math.round(1e6 * value) / 1e6)).toEqual([0.4, -0.3]);
  });

  it("keeps the sun from the edges", () => {
    const dome = domeOf({ ...PHONE, width: 200, height: 900 }, null);
    for (const [right, up] of [
      [-2, 9],
      [2, -9],
    ] as const) {
      const [x, y] = dome.pixels(shown(right, up));
      expect(x === 34 || x === 166).toBe(true);
      expect(y === 84 || y === 866).toBe(true);
    }
  });

  it("and from the bar, at whichever side it stands", () => {
    const [x] = domeOf(PHONE, BAR).pixels(shown(-1, 0));
    expect(PHONE.left + x).toBe(BAR.left + BAR.width + 28);
    const right = { ...BAR, left: 284 };
    const [other] = domeOf(PHONE, right).pixels(shown(1, 0));
    expect(PHONE.left + other).toBe(284 - 60);
    expect(domeOf(PHONE, right).pixels(shown(-1, 0))[0], "the free side is free").toBe(195 - 156);
  });
});
