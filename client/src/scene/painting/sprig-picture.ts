import { ATLAS_TILES, atlasLevels, coverageOf, type Levels, type Painting } from "./leaf-atlas";
import { seeded } from "./leaf-painter";
import { LeafTile } from "./leaf-tile";
import { SPRIG_LEAVES, SPRIG_REACH, TILE_MARGIN } from "./measures";

/** Texels along each side of a sprig's tile at its finest: it is never seen near. */
const SPRIG_SIDE = 128;

/** Times as many texels as each of the leaves has that a sprig is put together from: about as many as they get in it. */
const LEAVES_ACROSS = 2;
/** Share of the card that leaves would cover if none lay over another. */
const DENSITY = 0.3;
/** Places tried for each leaf, of which the one furthest from all others is taken. */
const TRIES = 24;
/** How far a leaf's plane leans out of the sprig's, as a slope; and how far its direction is from the sprig's, in radians. */
const TILT = 0.9;
const SPREAD = 1.5;
/** How much lighter or darker than the others a leaf may be. */
const SHADES = 0.22;

interface Placed {
  readonly x: number;
  readonly y: number;
  readonly angle: number;
  readonly tilt: readonly [number, number];
  readonly shade: number;
}

/**
 * Sprigs put together from single leaves, whose levels are given too. `span` says how many leaves long they are, so that
 * one covers exactly as much as the leaves it stands for. Where single leaves have few texels, so have they.
 */
export function sprigLevels(leaves: readonly Painting[], single: Levels, leafSide: number): Levels {
  const side = Math.min(SPRIG_SIDE, LEAVES_ACROSS * leafSide);
  const tiles = leaves.map((leaf) => leaf(side / LEAVES_ACROSS));
  const reach = tiles[0]!.reach;
  // Of a leaf's length squared.
  const area = 2 * reach * (1 + 2 * TILE_MARGIN) ** 2 * covered(single);
  const span = Math.sqrt((SPRIG_LEAVES * area) / DENSITY);
  const sprigs = leaves.map((_, i) => sprig(tiles, span, side, seeded(53 + i)));
  const levels = atlasLevels(
    sprigs.map((tile) => () => tile),
    side,
  );
  const card = 2 * SPRIG_REACH * (1 + 2 * TILE_MARGIN) ** 2;
  return { ...levels, span: Math.sqrt((SPRIG_LEAVES * area) / (card * Math.max(0.02, covered(levels)))) };
}

/** What share of a tile's square is inside, on the average. */
function covered({ colour }: Levels): number {
  const finest = colour[0]!;
  const side = Math.sqrt(finest.length / 4);
  let sum = 0;
  for (let tile = 0; tile < ATLAS_TILES ** 2; tile += 1) sum += coverageOf(finest, side, tile);
  return sum / ATLAS_TILES ** 2;
}

/** One picture: leaves strewn evenly, each somewhat another way. */
function sprig(tiles: readonly LeafTile[], span: number, side: number, random: () => number): LeafTile {
  const made = new LeafTile(SPRIG_REACH, side);
  const placed: Placed[] = [];
  for (let i = 0; i < SPRIG_LEAVES; i += 1) placed.push(placedAmong(placed, span, random));
  for (const [i, place] of placed.entries()) stamp(made, tiles[i % tiles.length]!, place, span);
  return made;
}

function placedAmong(others: readonly Placed[], span: number, random: () => number): Placed {
  // A leaf's middle stays so far inside that the leaf does too.
  const inset = Math.min(0.4, 0.5 / span);
  let [best, furthest] = [[0, 0.5] as readonly [number, number], -1];
  for (let i = 0; i < TRIES; i += 1) {
    const x = (1 - 2 * inset) * (random() - 0.5);
    const y = inset + (1 - 2 * inset) * random();
    const nearest = Math.min(1, ...others.map((other) => Math.hypot(other.x - x, other.y - y)));
    if (nearest > furthest) [best, furthest] = [[x, y], nearest];
  }
  return {
    x: best[0],
    y: best[1],
    angle: 2 * SPREAD * (random() - 0.5),
    tilt: [2 * TILT * (random() - 0.5), 2 * TILT * (random() - 0.5)],
    shade: 1 + 2 * SHADES * (random() - 0.5),
  };
}

/** Puts a leaf, 1 / `span` long, with its middle at a place. */
function stamp(made: LeafTile, leaf: LeafTile, { x, y, angle, tilt, shade }: Placed, span: number): void {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  for (let line = 0; line < made.side; line += 1) {
    const dy = made.y(line) - y;
    for (let column = 0; column < made.side; column += 1) {
      const dx = made.x(column) - x;
      const u = (cos * dx - sin * dy) * span;
      const v = (sin * dx + cos * dy) * span + 0.5;
      if (Math.abs(u) > leaf.reach || v < 0 || v > 1) continue;
      const from = leaf.nearest(u, v);
      const inside = leaf.alpha[from]!;
      if (inside <= 0) continue;
      made.blend(line * made.side + column, inside, {
        shade: leaf.shade[from]! * shade,
        tone: leaf.tone[from]!,
        sheer: leaf.sheer[from]!,
        wood: leaf.wood[from]!,
        height: leaf.height[from]! / span + tilt[0] * dx + tilt[1] * dy,
        margin: leaf.margin[from]!,
      });
    }
  }
}
