import { seasonOf } from "../../scene/foliage/leaf-season";
import { FLOWERS, FRUITS } from "../../scene/foliage/ornament-sorts";
import { isBearing } from "../../scene/foliage/places";
import type { TreeTable } from "../../scene/table/tree-table";
import { type Appearance, type ExportFormat, LEAF_NATURES } from "../../wire/generated";
import { POINTS } from "./export-choice";
import { pixelsDrawn, USUAL_SIZES } from "./picture-size";

/** What of a tree the size of its files goes by. */
export interface Amount {
  readonly metamers: number;
  /** Leaves that the season leaves. */
  readonly leaves: number;
  /** Whether they stand on twigs as sprays. */
  readonly sprays: boolean;
  /** Flowers and fruits. */
  readonly borne: number;
}

/** A spray has so many times the triangles of a leaf (`EX1`). */
const SPRAY = 2.25;
/** With more leaves than this each has half the triangles. */
const MANY = 60_000;

/** How much there is of a tree in this look. */
export function amountOf(table: TreeTable, { leaves: look, flowers, fruits }: Appearance): Amount {
  let [metamers, leaves, borne] = [0, 0, 0];
  const sorts = [
    [flowers, FLOWERS.salt, flowers.kind === "none" ? 0 : FLOWERS.kinds[flowers.kind].together],
    [fruits, FRUITS.salt, fruits.kind === "none" ? 0 : FRUITS.kinds[fruits.kind].together],
  ] as const;
  for (let row = 0; row < table.rows; row += 1) {
    if (table.radiusCode[row] === 0 || table.parent[row]! < 0) {
      continue;
    }
    metamers += 1;
    leaves += table.foliage[row]! & 15;
    for (const [placing, salt, together] of sorts) {
      borne += together > 0 && isBearing(table, row, placing, salt) ? together : 0;
    }
  }
  const { present } = seasonOf(look.shape, look.season);
  return { metamers, leaves: Math.round(present * leaves), sprays: LEAF_NATURES[look.shape].is_spray, borne };
}

/** About how many bytes the file of a tree has (`EX1`). */
export function bytesExpected(
  format: ExportFormat,
  options: ReadonlyMap<string, string>,
  { metamers, leaves, sprays, borne }: Amount,
): number {
  const [least, metamer, leaf] = format.bytes;
  const lod = options.get("lod") ?? "0";
  const isSet = lod === "set";
  const level = isSet ? format.levels.reduce((sum, share) => sum + share) : (format.levels[Number(lod)] ?? 1);
  let [wood, foliage] = [1, 1];
  for (const name of options.keys()) {
    const [ofWood, ofLeaves] = format.shares[name] ?? [1, 1];
    [wood, foliage] = [wood * ofWood, foliage * ofLeaves];
  }
  const usual = USUAL_SIZES[format.ending];
  const pictures = usual ? pixelsDrawn(format, options) / (usual.width * usual.height) : 1;
  const share = Number(options.get("points") ?? POINTS) / Number(POINTS);
  const ofTree = (each: number) =>
    least * share * pictures + level * (metamers * metamer * wood + each * leaves * leaf * foliage);
  if (!format.options.includes("lod")) {
    return ofTree(1);
  }
  // The coarsest level is pictures of all.
  const drawn = isSet ? format.levels.length - 1 : Number(lod) < format.levels.length - 1 ? 1 : 0;
  return ofTree((sprays ? SPRAY : 1) * (leaves > MANY ? 0.5 : 1)) + drawn * borne * leaf * wood;
}
