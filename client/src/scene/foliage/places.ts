import { type FlowerLook, type Place, THICKEST_BEARING } from "../../wire/generated";
import { leafHash } from "../leaf-hash";
import { radiusOf, type TreeTable } from "../table/tree-table";

/** Of sixteen numbers a row has for its leaves, the one that no leaf takes (LF2). */
const SPARE = 15;
const MOST_VIGOR = 15;

/** Where flowers or fruits may be, and how many of the places have some. */
export type Placing = Pick<FlowerLook, "share" | "place" | "vigor">;

/** Whether a row is a place of this sort. */
export function isPlace(table: TreeTable, row: number, place: Place): boolean {
  if (table.radiusCode[row] === 0 || table.parent[row]! < 0) return false;
  const leafy = (table.foliage[row]! & 15) > 0;
  switch (place) {
    case "tips":
      return table.successor[row]! < 0;
    case "twigs":
      return leafy;
    case "wood":
      return !leafy && radiusOf(table.radiusCode[row]!) < THICKEST_BEARING;
  }
}

/** How likely a place with so much vigor, 0 to 15, bears something. */
export function chanceOf({ share, vigor }: Omit<Placing, "place">, code: number): number {
  return share * Math.min(2, Math.max(0, 1 + vigor * ((2 * code) / MOST_VIGOR - 1)));
}

/** Whether a row bears something of this kind; the same rows whenever they are asked, and more with a larger share. */
export function isBearing(table: TreeTable, row: number, placing: Placing, salt: number): boolean {
  if (placing.share <= 0 || !isPlace(table, row, placing.place)) return false;
  return isChosen(row, table.foliage[row]! >> 4, placing, salt);
}

/** Whether a place with so much vigor, 0 to 15, bears something; the server's exports choose the same. */
export function isChosen(row: number, code: number, placing: Omit<Placing, "place">, salt: number): boolean {
  return leafHash((leafHash(16 * row + SPARE) + salt) >>> 0) / 2 ** 32 < chanceOf(placing, code);
}
