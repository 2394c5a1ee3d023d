import { describe, expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { CameraRig } from "./camera-rig";
import { frames, widened } from "./widening";

const view = () => structuredClone(new CameraRig().view);

describe("a camera that moves back", () => {
  it("shows any box whole, in the same direction, and is no nearer", () => {
    const random = randoms(7);
    for (let i = 0; i < 300; i += 1) {
      const from = { ...view(), yaw: 6 * random(), pitch: 2 * random() - 0.5, distance: 5 + 80 * random() };
      const min = [0, 1, 2].map(() => 60 * (random() - 0.5)) as [number, number, number];
      const box = { min, max: min.map((low) => low + 90 * random()) as [number, number, number] };
      const aspect = 0.4 + 2 * random();
      const to = widened(box, from, aspect);
      expect(frames(box, to, aspect)).toBe(true);
      expect([to.yaw, to.pitch]).toEqual([from.yaw, from.pitch]);
      expect(to.distance).toBeGreaterThanOrEqual(from.distance);
    }
  });

  it("stays where it is for what it shows with room around", () => {
    const box = { min: [-4, 8, -4], max: [4, 22, 4] } as const;
    const to = widened(box, view(), 1.4);
    expect(to).toEqual(view());
  });

  it("tells what is out of the picture", () => {
    expect(frames({ min: [-4, 8, -4], max: [4, 22, 4] }, view(), 1.4)).toBe(true);
    expect(frames({ min: [-4, 8, -4], max: [4, 60, 4] }, view(), 1.4)).toBe(false);
    expect(frames({ min: [-4, 8, -4], max: [40, 22, 4] }, view(), 1.4)).toBe(false);
    expect(frames({ min: [-4, 8, -4], max: [4, 22, 400] }, view(), 1.4), "behind the eye").toBe(false);
  });
});
