import { describe, expect, it } from "vitest";
import { Framing } from "./framing";

describe("the view of a written plant", () => {
  function at(height: number, follows = true) {
    const page = {
      height,
      fits: 0,
      stage: {
        view: { camera: { moves: 0 } },
        fitTree: () => {
          page.fits += 1;
          page.stage.view.camera.moves += 1;
        },
      },
      table: {
        bounds: () => ({
          min: [-1, 0, -1] as [number, number, number],
          max: [1, page.height, 1] as [number, number, number],
        }),
      },
      settings: { followsGrowth: { peek: () => follows } },
    };
    const framing = new Framing(page);
    const becomes = (height: number) => {
      page.height = height;
      framing.changed();
      framing.settled();
      return page.fits;
    };
    framing.planted();
    framing.settled();
    return { page, framing, becomes };
  }

  it("shows a new plant whole, and again when it is much larger or smaller", () => {
    const { page, becomes } = at(10);
    expect(page.fits).toBe(1);
    expect([becomes(10.5), becomes(14), becomes(14), becomes(8), becomes(8.5)]).toEqual([1, 2, 2, 3, 3]);
  });

  it("stays where somebody has put it, until another plant is planted", () => {
    const { page, framing, becomes } = at(10);
    page.stage.view.camera.moves += 1;
    expect(becomes(40)).toBe(1);
    framing.planted();
    framing.settled();
    expect(page.fits).toBe(2);
    expect(becomes(80)).toBe(3);
  });

  it("stays where somebody wants no camera that moves by itself, and when nothing was asked for", () => {
    expect(at(10, false).becomes(40)).toBe(1);
    const { page, framing } = at(10);
    page.height = 40;
    framing.settled();
    expect(page.fits).toBe(1);
  });
});
