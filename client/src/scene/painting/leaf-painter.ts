import { leafHash } from "../leaf-hash";
import type { Lamina, Random, Rib } from "./lamina";
import { LeafTile, type Paint } from "./leaf-tile";
import { TILE_SIDE } from "./measures";

/** As far from a vein as this, in lengths of the leaf, the blade no longer bends towards it. */
const VEIN_REACH = 0.05;
/** Texels within which the margin of a blade differs from its middle. */
const MARGIN_TEXELS = 9;
/** A needle that is to be seen is so many texels broad. */
const NEEDLE_TEXELS = 1.15;

/** A leaf or a spray as it looks from above. */
export function paintLeaf(lamina: Lamina, random: Random, side: number = TILE_SIDE): LeafTile {
  const tile = new LeafTile(lamina.reach, side);
  const speckle = mottles(random);
  if (lamina.blades.length > 0) paintBlades(tile, lamina, speckle);
  for (const stalk of lamina.stalks) tile.stroke(stalk, (_, aside) => wooden(stalk, aside, lamina.blades.length > 0));
  const { needles, share } = fewer(lamina.needles, tile);
  needles.forEach((needle, i) => {
    // Those painted first lie deepest, in the shade of the others; where one stands for many, it is as dark as they are.
    const shade = 0.5 + (0.34 * i) / needles.length + 0.5 * (random() - 0.5) * share;
    const young = needle.out ** 2;
    tile.stroke(needle, (along, aside) => ({
      shade: shade * (0.72 + 0.5 * along + 0.5 * young) * (1.06 - 0.12 * Math.abs(aside)),
      tone: 0.85 * young,
      sheer: 0.22,
      wood: 0,
      height: round(needle, along, aside),
    }));
  });
  return tile;
}

/** In a coarse picture fewer needles, each as broad as can be seen, that cover as much together. */
function fewer(needles: Lamina["needles"], tile: LeafTile): { needles: Lamina["needles"]; share: number } {
  const broadest = needles.reduce((most, { width }) => Math.max(most, width[0]), 0);
  const factor = Math.max(1, (NEEDLE_TEXELS * tile.texel[1]) / (broadest || 1));
  if (factor === 1) return { needles, share: 1 };
  const share = 1 / factor;
  return {
    // Chosen by the golden ratio, so that those left are spread over the whole.
    needles: needles
      .filter((_, i) => (i * 0.618034) % 1 < share)
      .map((needle) => ({ ...needle, width: [needle.width[0] * factor, needle.width[1] * factor] as const })),
    share,
  };
}

function paintBlades(tile: LeafTile, { blades, veins }: Lamina, speckle: (x: number, y: number) => number): void {
  const near = veinFields(tile, veins);
  for (const blade of blades) {
    tile.fill(blade, (x, y) => {
      const [off, thick] = near(x, y);
      const vein = Math.max(0, 1 - Math.max(0, off) / (0.6 * thick + 0.006));
      const quilt = Math.min(1, Math.max(0, off) / VEIN_REACH);
      const blotch = speckle(x, y);
      return {
        shade: 0.93 + 0.13 * quilt + 0.16 * blotch + 0.22 * vein,
        tone: 0.62 * vein + 0.12 * Math.max(0, blotch),
        sheer: 0.82 - 0.5 * vein + 0.14 * quilt,
        wood: 0,
        // Between veins the blade swells, along them it is sunk.
        height: 0.012 * Math.sqrt(quilt) - 0.004 * vein,
      };
    });
  }
  const depth = tile.depth(MARGIN_TEXELS);
  for (let at = 0; at < depth.length; at += 1) {
    // Half of what surrounds a place on the margin is inside.
    const margin = Math.min(1, Math.max(0, 2 - 2 * depth[at]!));
    tile.shade[at]! *= 1 - 0.1 * margin;
    tile.margin[at] = margin;
  }
}

/** For a place: how far the nearest vein's edge is, and how thick that vein is there. */
function veinFields(tile: LeafTile, veins: readonly Rib[]): (x: number, y: number) => readonly [number, number] {
  const cells = 24;
  const [w, h] = [2 * tile.reach, 1];
  const near: Rib[][] = Array.from({ length: cells * cells }, () => []);
  const cell = (x: number, y: number) => {
    const clamp = (i: number) => Math.min(cells - 1, Math.max(0, Math.floor(i)));
    return clamp((y / h) * cells) * cells + clamp((x / w + 0.5) * cells);
  };
  for (const vein of veins) {
    // Long veins pass through many cells; each gets them where they are near.
    const seen = new Set<number>();
    const steps = 2 + Math.ceil(Math.hypot(vein.to[0] - vein.from[0], vein.to[1] - vein.from[1]) * cells * 2);
    for (let i = 0; i <= steps; i += 1) {
      const x = vein.from[0] + ((vein.to[0] - vein.from[0]) * i) / steps;
      const y = vein.from[1] + ((vein.to[1] - vein.from[1]) * i) / steps;
      for (let dy = -2; dy <= 2; dy += 1) {
        for (let dx = -2; dx <= 2; dx += 1) {
          seen.add(cell(x + (dx * VEIN_REACH) / 2, y + (dy * VEIN_REACH) / 2));
        }
      }
    }
    for (const at of seen) near[at]!.push(vein);
  }
  return (x, y) => {
    let [least, thick] = [VEIN_REACH, 0.004];
    for (const { from, to, width } of near[cell(x, y)]!) {
      const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
      const along = Math.min(1, Math.max(0, ((x - from[0]) * dx + (y - from[1]) * dy) / (dx * dx + dy * dy || 1e-12)));
      const broad = width[0] + (width[1] - width[0]) * along;
      const off = Math.hypot(x - from[0] - along * dx, y - from[1] - along * dy) - broad / 2;
      if (off < least) [least, thick] = [off, broad];
    }
    return [least, thick];
  };
}

/** A twig, or the stalk of a leaf, which is greener. */
function wooden(rib: Rib, aside: number, green: boolean): Paint {
  const shade = 1.05 - 0.3 * Math.abs(aside);
  return { shade, tone: green ? 0.7 : 0, sheer: 0, wood: green ? 0.45 : 1, height: round(rib, 0, aside) };
}

/** How far the surface of something round stands out. */
export function round({ width }: Rib, along: number, aside: number): number {
  const half = (width[0] + (width[1] - width[0]) * along) / 2;
  return half * Math.sqrt(Math.max(0, 1 - aside * aside));
}

/** Soft blotches around zero: a few waves of any direction. */
function mottles(random: Random): (x: number, y: number) => number {
  const waves = Array.from({ length: 7 }, (_, i) => {
    const angle = 2 * Math.PI * random();
    const often = 9 + 7 * i;
    return [Math.cos(angle) * often, Math.sin(angle) * often, 2 * Math.PI * random()] as const;
  });
  return (x, y) => {
    let sum = 0;
    for (const [a, b, phase] of waves) sum += Math.sin(a * x + b * y + phase);
    return sum / waves.length;
  };
}

/** Numbers from 0 to 1 that are the same each time. */
export function seeded(seed: number): Random {
  let state = leafHash(seed);
  return () => {
    state = (state + 0x9e3779b9) >>> 0;
    return leafHash(state) / 2 ** 32;
  };
}

/** The slope of the heights at a texel: across and along, in lengths to a length; none over the edge of what is painted. */
export function slopeAt(tile: LeafTile, at: number): readonly [number, number] {
  const [tx, ty] = tile.texel;
  const slope = (before: number, after: number, span: number) => {
    const [a, b] = [inside(tile, before) ? before : at, inside(tile, after) ? after : at];
    const steps = (a === at ? 0 : 1) + (b === at ? 0 : 1);
    return steps === 0 ? 0 : (tile.height[b]! - tile.height[a]!) / (steps * span);
  };
  return [slope(at - 1, at + 1, tx), slope(at - tile.side, at + tile.side, ty)];
}

function inside(tile: LeafTile, at: number): boolean {
  return at >= 0 && at < tile.alpha.length && tile.alpha[at]! > 0.3;
}
