import { describe, expect, it } from "vitest";
import { shaderFunctions } from "../../../test/shader-functions";
import type { LeafKind } from "../../wire/generated";
import { EDGE } from "../glsl/leaf";
import { laminaOf } from "./lamina";
import { ATLAS_TILES, atlasLevels, coverageOf } from "./leaf-atlas";
import { paintLeaf, seeded } from "./leaf-painter";
import { LeafTile } from "./leaf-tile";
import { TILE_SIDE } from "./measures";

const SIDE = ATLAS_TILES * TILE_SIDE;

/** An atlas of four leaves of a kind, whole or painted anew down to so many texels. */
function levelsOf(kind: LeafKind, coarsest?: number) {
  const paintings = [0, 1, 2, 3].map((i) => {
    const lamina = laminaOf(kind, seeded(31 + i));
    return (side: number) => paintLeaf(lamina, seeded(7 + i), side);
  });
  return atlasLevels(paintings, TILE_SIDE, coarsest);
}

const { edgeOf, leastOf } = shaderFunctions<{
  edgeOf(covered: number, slope: readonly number[]): number;
  leastOf(grain: number, pixels: number): number;
}>(EDGE, ["edgeOf", "leastOf"]);

/** The share of a tile that is drawn where a texel is a pixel: of a pixel's samples, or of many pixels of a grain each. */
function drawnOf(level: Uint8Array, side: number, tile: number) {
  const span = side / ATLAS_TILES;
  const corner = (tile % ATLAS_TILES) * span + Math.floor(tile / ATLAS_TILES) * span * side;
  const [least, most] = [leastOf(0, span), leastOf(1, span)];
  const sum = { samples: 0, grain: 0 };
  for (let y = 0; y < span; y += 1) {
    for (let x = 0; x < span; x += 1) {
      const at = (dx: number, dy: number) =>
        level[4 * (corner + Math.min(y + dy, span - 1) * side + Math.min(x + dx, span - 1)) + 3]! / 255;
      const there = edgeOf(at(0, 0), [at(1, 0) - at(0, 0), at(0, 1) - at(0, 0)]);
      sum.samples += there < 0.12 ? 0 : there;
      sum.grain += Math.min(1, Math.max(0, (there - least) / (most - least)));
    }
  }
  return { samples: sum.samples / span ** 2, grain: sum.grain / span ** 2 };
}

describe.each([
  ["palmate", undefined],
  ["lanceolate", undefined],
  ["needle", 8],
] as const)("%s leaves", (kind, coarsest) => {
  const { colour, relief } = levelsOf(kind, coarsest);

  it("cover as much from afar as from near", () => {
    for (let tile = 0; tile < 4; tile += 1) {
      const near = coverageOf(colour[0]!, SIDE, tile);
      expect(near).toBeGreaterThan(0.1);
      expect(near).toBeLessThan(0.9);
      for (let level = 1; SIDE >> level >= 32; level += 1) {
        const afar = coverageOf(colour[level]!, SIDE >> level, tile);
        expect(Math.abs(afar - near), `tile ${tile} at ${SIDE >> level} texels`).toBeLessThan(0.09);
      }
    }
  });

  it("cover as much through the edges that shaders draw, with samples and without", () => {
    for (let tile = 0; tile < 4; tile += 1) {
      const near = coverageOf(colour[0]!, SIDE, tile);
      for (let level = 0; SIDE >> level >= 32; level += 1) {
        const drawn = drawnOf(colour[level]!, SIDE >> level, tile);
        expect(Math.abs(drawn.samples - near), `tile ${tile} at ${SIDE >> level}, samples`).toBeLessThan(0.09);
        expect(Math.abs(drawn.grain - near), `tile ${tile} at ${SIDE >> level}, none`).toBeLessThan(0.09);
      }
    }
  });

  it("have a level for every size down to one texel", () => {
    for (const levels of [colour, relief]) {
      expect(levels.map(({ length }) => Math.sqrt(length / 4))).toEqual([512, 256, 128, 64, 32, 16, 8, 4, 2, 1]);
    }
  });

  it("keep clear of the edges that tiles share", () => {
    const [finest] = colour;
    for (let i = 0; i < SIDE; i += 1) {
      for (const at of [i, i * SIDE, (TILE_SIDE - 1) * SIDE + i, i * SIDE + TILE_SIDE]) {
        expect(finest![4 * at + 3]).toBeLessThan(128);
      }
    }
  });
});

it("what is outside lends no colour to what is inside", () => {
  const half = () => {
    const tile = new LeafTile(0.5);
    const corners = [
      [-0.5, 0],
      [0, 0],
      [0, 1],
      [-0.5, 1],
    ] as const;
    tile.fill(corners, () => ({ shade: 1.5, tone: 0, sheer: 0, wood: 0, height: 0 }));
    return tile;
  };
  const { colour } = atlasLevels([half, half, half, half]);
  const [finest] = colour;
  const middle = (TILE_SIDE / 2) * SIDE;
  const right = Array.from({ length: TILE_SIDE / 2 + 8 }, (_, x) => 4 * (middle + TILE_SIDE / 2 - 4 + x));
  const outside = right.filter((at) => finest![at + 3] === 0).slice(0, 4);
  expect(outside.map((at) => finest![at]! > 186)).toEqual([true, true, true, true]);
  for (const level of colour) {
    const brightness = level.filter((_, i) => i % 4 === 0 && level[i + 3]! > 127);
    if (level.length > 16) expect(brightness.length).toBeGreaterThan(0);
    expect(brightness.every((value) => value > 186)).toBe(true);
  }
});

it("a fill covers exactly its outline's area", () => {
  const tile = new LeafTile(0.5);
  const corners = [
    [-0.31, 0.2],
    [0.27, 0.2],
    [0.27, 0.83],
    [-0.31, 0.83],
  ] as const;
  tile.fill(corners, () => ({ shade: 1, tone: 0, sheer: 0, wood: 0, height: 0 }));
  const [tx, ty] = tile.texel;
  const covered = tile.alpha.reduce((sum, alpha) => sum + alpha, 0) * tx * ty;
  expect(covered).toBeCloseTo(0.58 * 0.63, 2);
});
