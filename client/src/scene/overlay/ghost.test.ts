import type { Mesh } from "three";
import { describe, expect, it } from "vitest";
import { itemsOf } from "../../../test/items";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { subtreeRows } from "../table/branch-rows";
import type { TreeTable } from "../table/tree-table";
import { Ghost } from "./ghost";

function tree(): TreeTable {
  const table = new PlainTable(() => 0);
  table.apply({ ...sampleTree({ seed: 3, height: 8, orders: 2 }), catchUp: true });
  return table;
}

/** The rows whose wood is drawn, in any order, by the meshes of one pass. */
function wood(ghost: Ghost, pass: 1 | 2): number[] {
  const rows: number[] = [];
  for (const mesh of ghost.group.children as Mesh[]) {
    if (!mesh.geometry.hasAttribute("ring") || mesh.renderOrder !== pass) continue;
    rows.push(...itemsOf(mesh, 4).map(([row]) => row!));
  }
  // A trunk is drawn once more for each of its roots.
  return [...new Set(rows)].sort((a, b) => a - b);
}

const living = (table: TreeTable) =>
  Array.from({ length: table.rows }, (_, row) => row).filter(
    (row) => table.parent[row]! >= 0 && table.radiusCode[row] !== 0,
  );

describe("a ghost", () => {
  it("has all the wood of its table, in both passes", () => {
    const [ghost, table] = [new Ghost({}), tree()];
    ghost.show(table, null);
    expect(wood(ghost, 1)).toEqual(living(table));
    expect(wood(ghost, 2)).toEqual(living(table));
    expect(ghost.group.visible).toBe(true);
  });

  it("of a branch has that branch alone, even after a larger one", () => {
    const [ghost, table] = [new Ghost({}), tree()];
    const first = living(table).find((row) => table.startsAxis[row] === 1 && table.parent[table.parent[row]!]! >= 0)!;
    const rows = subtreeRows(table, first, 1000);
    ghost.show(table, null);
    ghost.show(table, rows);
    expect(wood(ghost, 2)).toEqual(rows);
    expect(rows.length).toBeLessThan(living(table).length);
  });

  it("draws the very same surface twice, or it would hide itself", () => {
    const [ghost, table] = [new Ghost({}), tree()];
    ghost.show(table, null);
    const shapes = (pass: number) =>
      (ghost.group.children as Mesh[])
        .filter(({ renderOrder }) => renderOrder === pass)
        .map(({ geometry }) => geometry.uuid)
        .sort();
    expect(shapes(1)).toEqual(shapes(2));
  });

  it("is as large as what it shows, where it stands", () => {
    const [ghost, table] = [new Ghost({}), tree()];
    ghost.show(table, null);
    ghost.place({ turn: [0, 0, 0, 1], from: [0, 0, 0], to: [30, 0, -4] });
    const [mine, its] = [ghost.bounds()!, table.bounds()];
    for (const axis of [0, 1, 2] as const) {
      const away = [30, 0, -4][axis]!;
      expect(mine.max[axis]).toBeCloseTo(its.max[axis] + away, 4);
    }
    // Turned right round it lies on the other side.
    ghost.place({ turn: [0, 1, 0, 0], from: [0, 0, 0], to: [0, 0, 0] });
    expect(ghost.bounds()!.min[0]).toBeCloseTo(-its.max[0], 4);
  });

  it("that is hidden takes no room", () => {
    const [ghost, table] = [new Ghost({}), tree()];
    ghost.show(table, null);
    ghost.hide();
    expect([ghost.bounds(), ghost.group.visible, wood(ghost, 2)]).toEqual([null, false, []]);
  });
});
