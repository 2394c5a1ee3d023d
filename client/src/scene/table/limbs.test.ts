import { describe, expect, it } from "vitest";
import { SMALL, type Twig, tableOf } from "../../../test/small-tree";
import type { TreeTable } from "./tree-table";

/** The rows of a limb, from where it begins. */
function limb({ limbs }: TreeTable, from: number): number[] {
  const rows = [];
  for (let row = from; row >= 0; row = limbs.onward[row]!) rows.push(row);
  return rows;
}

/** A trunk of three (1 to 3) that goes on as a twig (4, 5), and a lateral from row 3 (6, 7) of some girth and direction. */
const forked = (lateral: number, aside: readonly [number, number] = [1, 1]): readonly Twig[] => [
  { parent: -1, at: [0, 0, 0] },
  ...[1, 2, 3].map((y) => ({ parent: y - 1, at: [0, y, 0] as const, radius: 1 })),
  ...[4, 5].map((y) => ({ parent: y - 1, at: [0, y, 0] as const, radius: 0.5 })),
  { parent: 3, at: [aside[0], 3 + aside[1], 0], begins: true, radius: lateral },
  { parent: 6, at: [2 * aside[0], 3 + 2 * aside[1], 0], radius: lateral },
];

function patchRadius(table: TreeTable, row: number, from: TreeTable): void {
  const values = Int32Array.of(from.radiusCode[row]!);
  const rows = Uint8Array.of(row);
  const change = { change: "patch", chunk: 0, generation: 2, column: "radius", rows, values } as const;
  table.apply({ epoch: 1, sequence: table.sequence! + 1, catchUp: true, changes: [change] });
}

describe("a limb", () => {
  it("is its axis where that goes on thickest", () => {
    const table = tableOf(SMALL);
    expect(limb(table, 1)).toEqual([1, 2, 3, 4, 5]);
    expect([6, 10, 12].map((row) => table.limbs.begins[row])).toEqual([1, 1, 1]);
    expect(limb(table, 6)).toEqual([6, 7, 8, 9]);
  });

  it("goes on into a lateral that leads, with its bark", () => {
    const table = tableOf(forked(0.9));
    expect(limb(table, 1)).toEqual([1, 2, 3, 6, 7]);
    expect(table.limbs.begins[4]).toBe(1);
    expect(limb(table, 4)).toEqual([4, 5]);
    expect([table.limbOrigin[7], table.limbOrigin[4], table.limbOrigin[5]]).toEqual([0, 3, 3]);
    expect(table.arc[6]).toBeCloseTo(3 + Math.SQRT2, 3);
    expect(table.arc[4]).toBeCloseTo(1, 3);
  });

  it("stays with its axis if both are much alike", () => {
    expect(limb(tableOf(forked(0.55)), 1)).toEqual([1, 2, 3, 4, 5]);
  });

  it("does not double back into a lateral", () => {
    expect(limb(tableOf(forked(0.9, [1, -0.5])), 1)).toEqual([1, 2, 3, 4, 5]);
  });

  it("changes its way when a lateral comes to lead", () => {
    const table = tableOf(forked(0.45));
    patchRadius(table, 6, tableOf(forked(0.9)));
    expect(limb(table, 1)).toEqual([1, 2, 3, 6, 7]);
    expect(table.limbOrigin[5]).toBe(3);
    patchRadius(table, 6, tableOf(forked(0.45)));
    expect(limb(table, 1)).toEqual([1, 2, 3, 4, 5]);
    expect(table.limbOrigin[7]).toBe(3);
    expect(table.limbOrigin[5]).toBe(0);
  });

  it("goes on around the corner where its axis was cut", () => {
    const cut = (lateral: number) =>
      tableOf(forked(lateral, [1, 0]).map((twig, row) => (row === 4 || row === 5 ? { ...twig, dead: true } : twig)));
    expect(limb(cut(0.8), 1)).toEqual([1, 2, 3, 6, 7]);
    expect(limb(cut(0.3), 1)).toEqual([1, 2, 3]);
  });

  it("ends where its rows do", () => {
    const table = tableOf(forked(0.9));
    table.apply({ epoch: 1, sequence: 2, catchUp: true, changes: [{ change: "truncate", rows: 6 }] });
    expect(limb(table, 1)).toEqual([1, 2, 3, 4, 5]);
    expect(table.limbOrigin[4]).toBe(0);
  });
});
