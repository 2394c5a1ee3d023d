import { slopeAt } from "./leaf-painter";
import type { LeafTile } from "./leaf-tile";
import { TILE_SIDE } from "./measures";

/** Tiles along each side of an atlas: as many pictures of one thing as there are, so that it does not repeat. */
export const ATLAS_TILES = 2;
/** Where the shaders draw the line between a leaf and none. */
const THRESHOLD = 0.5;
/** Texels outside a leaf that have the colour of its edge: looked at between texels, an edge would else be dark. */
const BLEED = 4;

/** The levels of a mipmap, the finest first: four bytes a texel. */
export interface Levels {
  /** Half the brightness, second colour, sheerness, coverage. */
  readonly colour: Uint8Array<ArrayBuffer>[];
  /** Normal across and along, about 128; wood; margin. */
  readonly relief: Uint8Array<ArrayBuffer>[];
  /** How many leaves long the picture is, where it is of several. */
  readonly span?: number;
  /** Half the width of the card it is for, in the length of a leaf. */
  readonly reach?: number;
}

/** A tile with so many texels along each side. */
export type Painting = (side: number) => LeafTile;

/**
 * Four tiles of so many texels a side as one picture, with coarser ones made of it that cover as much of each tile as the
 * finest does; or painted anew, down to `coarsest` texels a side, for what would run together.
 */
export function atlasLevels(paintings: readonly Painting[], finest: number = TILE_SIDE, coarsest = finest): Levels {
  const levels: Levels = { colour: [], relief: [] };
  for (let side = ATLAS_TILES * finest; side >= 1; side /= 2) {
    if (side >= ATLAS_TILES * coarsest) {
      paint(
        levels,
        paintings.map((painting) => painting(side / ATLAS_TILES)),
      );
      continue;
    }
    const [above, beside] = [levels.colour.at(-1)!, levels.relief.at(-1)!];
    levels.colour.push(halved(above, above, side));
    levels.relief.push(halved(beside, above, side));
  }
  for (let tile = 0; tile < ATLAS_TILES * ATLAS_TILES; tile += 1)
    keepCoverage(levels.colour, tile, ATLAS_TILES * finest);
  return levels;
}

/** Adds a level with these tiles. */
function paint(levels: Levels, tiles: readonly LeafTile[]): void {
  const span = tiles[0]!.side;
  const side = ATLAS_TILES * span;
  const colour = new Uint8Array(4 * side * side);
  const relief = new Uint8Array(4 * side * side);
  tiles.forEach((tile, i) => {
    const corner = (i % ATLAS_TILES) * span + Math.floor(i / ATLAS_TILES) * span * side;
    for (let at = 0; at < span * span; at += 1) {
      const to = 4 * (corner + Math.floor(at / span) * side + (at % span));
      colour[to] = byte(tile.shade[at]! / 2);
      colour[to + 1] = byte(tile.tone[at]!);
      colour[to + 2] = byte(tile.sheer[at]!);
      colour[to + 3] = byte(tile.alpha[at]!);
      const [sx, sy] = tile.alpha[at]! > 0 ? slopeAt(tile, at) : [0, 0];
      const steep = Math.hypot(sx, sy, 1);
      relief[to] = 128 + Math.round((-127 * sx) / steep);
      relief[to + 1] = 128 + Math.round((-127 * sy) / steep);
      relief[to + 2] = byte(tile.wood[at]!);
      relief[to + 3] = byte(tile.margin[at]!);
    }
  });
  bleed(colour, relief, side);
  levels.colour.push(colour);
  levels.relief.push(relief);
}

/** Gives what lies just outside the colour and relief of what is next to it; its coverage stays none. */
function bleed(colour: Uint8Array, relief: Uint8Array, side: number): void {
  const known = new Uint8Array(side * side);
  for (let at = 0; at < known.length; at += 1) known[at] = colour[4 * at + 3]! > 0 ? 1 : 0;
  const around = (at: number) => {
    const x = at % side;
    return [x > 0 ? at - 1 : -1, x < side - 1 ? at + 1 : -1, at - side, at + side < known.length ? at + side : -1];
  };
  for (let round = 0; round < BLEED; round += 1) {
    const edge: number[] = [];
    for (let at = 0; at < known.length; at += 1) {
      if (known[at] === 0 && around(at).some((next) => next >= 0 && known[next] === 1)) edge.push(at);
    }
    for (const at of edge) {
      const nexts = around(at).filter((next) => next >= 0 && known[next] === 1);
      const mean = (texels: Uint8Array, i: number) =>
        nexts.reduce((sum, next) => sum + texels[4 * next + i]!, 0) / nexts.length;
      for (let i = 0; i < 4; i += 1) {
        if (i < 3) colour[4 * at + i] = Math.round(mean(colour, i));
        relief[4 * at + i] = Math.round(mean(relief, i));
      }
    }
    for (const at of edge) known[at] = 1;
  }
}

/** What share of a tile's texels is inside, if coverages count `factor` times. */
export function coverageOf(level: Uint8Array, side: number, tile: number, factor = 1): number {
  const span = Math.max(1, side / ATLAS_TILES);
  const left = (tile % ATLAS_TILES) * span;
  const low = Math.floor(tile / ATLAS_TILES) * span;
  let inside = 0;
  for (let y = low; y < low + span; y += 1) {
    for (let x = left; x < left + span; x += 1) {
      if (level[4 * (y * side + x) + 3]! * factor >= 255 * THRESHOLD) inside += 1;
    }
  }
  return inside / (span * span);
}

/** Each texel from the four it stands for, as far as they are covered: what is outside has no colour. */
function halved(above: Uint8Array, weights: Uint8Array, side: number): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(4 * side * side);
  const isColour = above === weights;
  const channels = isColour ? 3 : 4;
  for (let y = 0; y < side; y += 1) {
    for (let x = 0; x < side; x += 1) {
      const to = 4 * (y * side + x);
      const a = 16 * y * side + 8 * x;
      const [b, c, d] = [a + 4, a + 8 * side, a + 8 * side + 4];
      const [wa, wb, wc, wd] = [weights[a + 3]!, weights[b + 3]!, weights[c + 3]!, weights[d + 3]!];
      const weight = wa + wb + wc + wd;
      for (let i = 0; i < channels; i += 1) {
        out[to + i] =
          weight > 0
            ? (above[a + i]! * wa + above[b + i]! * wb + above[c + i]! * wc + above[d + i]! * wd) / weight
            : (above[a + i]! + above[b + i]! + above[c + i]! + above[d + i]!) / 4;
      }
      if (isColour) out[to + 3] = weight / 4;
    }
  }
  return out;
}

/** Scales the coverages of a tile's coarser levels until each has as much inside as the finest. */
function keepCoverage(levels: Uint8Array[], tile: number, finest: number): void {
  const wanted = coverageOf(levels[0]!, finest, tile);
  for (let level = 1, side = finest / 2; side >= ATLAS_TILES; level += 1, side /= 2) {
    const texels = levels[level]!;
    let [low, high] = [0, 8];
    for (let i = 0; i < 12; i += 1) {
      const middle = (low + high) / 2;
      if (coverageOf(texels, side, tile, middle) < wanted) low = middle;
      else high = middle;
    }
    const span = side / ATLAS_TILES;
    const corner = (tile % ATLAS_TILES) * span + Math.floor(tile / ATLAS_TILES) * span * side;
    for (let i = 0; i < span * span; i += 1) {
      const at = 4 * (corner + Math.floor(i / span) * side + (i % span)) + 3;
      texels[at] = Math.min(255, Math.ceil(texels[at]! * high));
    }
  }
}

function byte(share: number): number {
  return Math.round(255 * Math.min(1, Math.max(0, share)));
}
