import { describe, expect, it } from "vitest";
import { tilesOf } from "./picture-tiles";

describe("the tiles of a picture", () => {
  it("cover it once, and none is large", () => {
    for (const [width, height] of [
      [300, 200],
      [1024, 1024],
      [3840, 2678],
    ] as const) {
      const tiles = tilesOf(width, height);
      expect(tiles.reduce((sum, tile) => sum + tile.width * tile.height, 0)).toBe(width * height);
      expect(new Set(tiles.map(({ x, y }) => `${x} ${y}`)).size).toBe(tiles.length);
      const within = tiles.every((tile) => tile.x + tile.width <= width && tile.y + tile.height <= height);
      expect(within && tiles.every((tile) => tile.width <= 1024 && tile.height <= 1024)).toBe(true);
    }
  });
});
