import { describe, expect, it } from "vitest";
import type { Schematic } from "../../../../wire/generated";
import { layoutOf, pictureOf } from "./schematic-picture";

/** A stem of two internodes, a side shoot that hangs below the ground. */
const tree: Schematic = {
  segments: [0, 0, 0, 1, 0, 1, 0, 2, 0, 1, 3, -1],
  parents: [-1, 0, 0],
  radii: [0.2, 0.05, 0.051],
  orders: [0, 0, 1],
  vigor: [1, 1, 0.5],
  light: [1, 1, 0.4],
  leaves: [0, 4, 2],
  born: [1, 2, 3],
};

describe("picture of the schematic tree", () => {
  it("draws lines of about one girth together, thin ones first", () => {
    const { wood } = pictureOf(tree);
    expect(wood.map(({ path }) => path)).toEqual(["M0 1L0 2M0 1L3 -1", "M0 0L0 1"]);
    expect(wood[0]!.width).toBeCloseTo(0.1, 1);
    expect(wood[1]!.width).toBeCloseTo(0.4, 1);
  });

  it("has a mark for each place with leaves", () => {
    expect(pictureOf(tree).leaves).toBe("M0 2h0M3 -1h0");
  });

  it("fits into every frame, below the ground as well", () => {
    const picture = pictureOf(tree);
    for (const [width, height] of [
      [320, 240],
      [360, 104],
      [90, 400],
    ] as const) {
      const { scale, ground } = layoutOf(picture, width, height);
      expect(scale).toBeGreaterThan(0);
      expect(width / 2 + 3 * scale).toBeLessThanOrEqual(width);
      expect(ground + 1 * scale).toBeLessThanOrEqual(height);
      expect(ground - 2 * scale).toBeGreaterThanOrEqual(0);
    }
  });

  it("a tree of nothing has a layout too", () => {
    const empty = pictureOf({ ...tree, segments: [], radii: [], leaves: [] });
    const { scale, ground } = layoutOf(empty, 320, 240);
    expect([Number.isFinite(scale), scale > 0, ground <= 240]).toEqual([true, true, true]);
  });
});
