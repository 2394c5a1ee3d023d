import type { LeafKind } from "../../wire/generated";
import { isSpray, laminaOf } from "./lamina";
import { ATLAS_TILES, atlasLevels, type Levels } from "./leaf-atlas";
import { paintLeaf, seeded } from "./leaf-painter";
import { sprigLevels } from "./sprig-picture";

/** Sprays are painted anew for each distance, down to so many texels: thin needles would run together to a blot. */
const COARSEST_SPRAY = 8;

const reaches = new Map<LeafKind, number>();

/** Half the width of a kind's card: of the broadest leaf there may be, so that all its pictures are to one scale. */
export function reachOf(kind: LeafKind): number {
  let reach = reaches.get(kind);
  if (reach === undefined) {
    reach = Math.max(...specimens(kind).map((lamina) => lamina.reach));
    reaches.set(kind, reach);
  }
  return reach;
}

/** Pictures of a kind of leaf: single ones, with so many texels a side at their finest, and sprigs of several. */
export function leafLevels(kind: LeafKind, side: number): Levels[] {
  const reach = reachOf(kind);
  const paintings = specimens(kind).map(
    (lamina, i) => (side: number) => paintLeaf({ ...lamina, reach }, seeded(7 + i), side),
  );
  const single = atlasLevels(paintings, side, isSpray(kind) ? Math.min(side, COARSEST_SPRAY) : side);
  return [{ ...single, reach }, sprigLevels(paintings, single, side)];
}

function specimens(kind: LeafKind) {
  return Array.from({ length: ATLAS_TILES ** 2 }, (_, i) => laminaOf(kind, seeded(31 + i)));
}
