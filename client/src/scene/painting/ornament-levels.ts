import { ATLAS_TILES, atlasLevels, type Levels } from "./leaf-atlas";
import { seeded } from "./leaf-painter";
import type { LeafTile } from "./leaf-tile";

/** Paints one picture of a flower or fruit, with so many texels along each side. */
export type OrnamentPicture = (random: () => number, side?: number) => LeafTile;

/** The pictures of all kinds of flowers, or of all fruits. */
export type OrnamentPictures<Kind extends string> = Readonly<Record<Exclude<Kind, "none">, OrnamentPicture>>;

/** Four pictures of a kind of flower or fruit. */
export function ornamentLevels(picture: OrnamentPicture, side: number): Levels {
  const tiles = Array.from({ length: ATLAS_TILES ** 2 }, (_, i) => picture(seeded(97 + i), side));
  return atlasLevels(
    tiles.map((tile) => () => tile),
    side,
  );
}
