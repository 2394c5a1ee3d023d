import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { expect, it } from "vitest";
import { pngOf, texelsOf } from "../../../test/png";
import { type BarkKind, LEAF_NATURES, type LeafKind } from "../../wire/generated";
import { BARK_PATTERNS } from "./bark-pattern";
import { barkTexels } from "./bark-relief";
import { FLOWER_PICTURES } from "./flowers";
import { FRUIT_PICTURES } from "./fruits";
import { ATLAS_TILES, type Levels } from "./leaf-atlas";
import { leafLevels, reachOf } from "./leaf-pictures";
import { MOST_SHADE, MOST_SLOPE, TILE_MARGIN } from "./measures";
import { ornamentLevels } from "./ornament-levels";

/*
 * Exports show what is painted here: the server has these pictures as files, colours above reliefs.
 *
 * After a deliberate change: UPDATE_GOLDEN=1 npx vitest run painted
 */

const FOLDER = new URL("../../../../server/export/painted/", import.meta.url);
/** Texels along a square of bark, and along one of an atlas' tiles. */
const SIDES = { bark: 256, leaf: 128, ornament: 64 } as const;

/** Six of eight bits: nobody sees the others, and the files are a third smaller. */
const coarse = (texels: Uint8Array) => texels.map((byte) => (byte & 0xfc) | (byte >> 6));
const ofLevels = ({ colour, relief }: Levels) => [colour[0]!, relief[0]!] as const;

const leaves = Object.keys(LEAF_NATURES) as LeafKind[];
const pictures: readonly (readonly [string, () => readonly [Uint8Array, Uint8Array]])[] = [
  ...leaves.map((kind) => [`leaf-${kind}`, () => ofLevels(leafLevels(kind, SIDES.leaf)[0]!)] as const),
  ...Object.entries(FLOWER_PICTURES).map(
    ([kind, paint]) => [`flower-${kind}`, () => ofLevels(ornamentLevels(paint, SIDES.ornament))] as const,
  ),
  ...Object.entries(FRUIT_PICTURES).map(
    ([kind, paint]) => [`fruit-${kind}`, () => ofLevels(ornamentLevels(paint, SIDES.ornament))] as const,
  ),
  ...(Object.keys(BARK_PATTERNS) as BarkKind[]).map((kind) => {
    const paint = () => {
      const { colours, relief } = barkTexels(kind, SIDES.bark);
      return [colours, relief] as const;
    };
    return [`bark-${kind}`, paint] as const;
  }),
];

it.each(pictures)("%s looks in exports as it does here", (name, paint) => {
  const painted = coarse(Buffer.concat(paint()));
  const file = new URL(`${name}.png`, FOLDER);
  if (process.env.UPDATE_GOLDEN) {
    mkdirSync(FOLDER, { recursive: true });
    writeFileSync(file, pngOf(Math.sqrt(painted.length / 8), painted));
  }
  const kept = existsSync(file) ? texelsOf(readFileSync(file)) : new Uint8Array(0);
  expect(kept.length).toBe(painted.length);
  // Another engine may round a power otherwise.
  const off = kept.reduce((count, byte, at) => count + (Math.abs(byte - painted[at]!) > 4 ? 1 : 0), 0);
  expect(off).toBeLessThan(painted.length / 1000);
});

it("exports know how the pictures are laid out", () => {
  const layout = {
    tiles: ATLAS_TILES,
    margin: TILE_MARGIN,
    most_shade: MOST_SHADE,
    most_slope: MOST_SLOPE,
    leaf_reach: Object.fromEntries(leaves.map((kind) => [kind, Math.fround(reachOf(kind))])),
  };
  const file = new URL("layout.json", FOLDER);
  if (process.env.UPDATE_GOLDEN) writeFileSync(file, `${JSON.stringify(layout, null, 2)}\n`);
  expect(JSON.parse(readFileSync(file, "utf8"))).toEqual(layout);
});
