import { describe, expect, it } from "vitest";
import { seen, told } from "./cameras";
import { thinned } from "./own-pointer";
import { OwnWords } from "./own-words";

const CAMERA = { target: [0, 8, 0] as [number, number, number], yaw: 0, pitch: 0, distance: 40 };
const turned = (yaw: number) => ({ ...CAMERA, yaw });

describe("what a page says of itself", () => {
  it("PS1: is said once, and again only where something is new", () => {
    const words = new OwnWords();
    const here = { type: "here", tool: "brush" } as const;
    expect(words.next(0, here, null, "", false)).toEqual(here);
    expect(words.next(50, { ...here }, null, "", false)).toBeNull();
    expect(words.next(100, { type: "here" }, null, "Ann", false)).toEqual({ type: "here", name: "Ann" });
    expect(words.next(150, { type: "here" }, null, "Ann", false)).toBeNull();
    words.again();
    expect(words.next(200, { type: "here" }, CAMERA, "Ann", false)).toEqual({
      type: "here",
      camera: CAMERA,
      name: "Ann",
    });
  });

  it("PS4: a camera that is followed is said at once, another one twice a second", () => {
    const words = new OwnWords();
    const cameras = (followed: boolean, from: number) =>
      Array.from({ length: 20 }, (_, i) => {
        const now = from + 50 * i;
        return words.next(now, { type: "here" }, turned(now), "", followed)?.camera;
      }).filter((camera) => camera !== undefined).length;
    expect(cameras(false, 0)).toBe(2);
    expect(cameras(true, 1000)).toBe(20);
  });
});

describe("cameras", () => {
  it("LM20: any turn is told within its bounds, and is the same view", () => {
    for (const yaw of [-40, -3.2, 0, 1.5, 3.2, 100]) {
      const view = { target: [0, 8, 0] as [number, number, number], yaw, pitch: -0.1, distance: 40 };
      const camera = told(view);
      expect(Math.abs(camera.yaw)).toBeLessThanOrEqual(180);
      const back = seen(camera);
      expect(Math.cos(back.yaw - yaw)).toBeCloseTo(1, 6);
      expect(back.pitch).toBeCloseTo(-0.1, 4);
    }
  });
});

describe("a line that is being drawn", () => {
  it("LM20: is told by so many places, its ends among them", () => {
    const line = Array.from({ length: 500 }, (_, i) => i);
    const told = thinned(line, 48);
    expect([told.length, told[0], told[47]]).toEqual([48, 0, 499]);
    expect(thinned([1, 2], 48)).toEqual([1, 2]);
  });
});
