import type { Mesh } from "three";
import { expect, it } from "vitest";
import { randoms } from "../../test/randoms";
import { sampleTree } from "../../test/sample-tree";
import type { ChunkChange } from "../wire/frame";
import { CHUNK_ROWS } from "../wire/generated";
import { Branches } from "./branches";
import { Foliage } from "./foliage";
import { makeMaterials } from "./materials";
import { Dirty, TreeTable } from "./tree-table";

/** Every row that instances of these meshes draw, with its parent. */
function drawn(meshes: Mesh[]): Map<number, number> {
  const rows = new Map<number, number>();
  for (const { geometry } of meshes) {
    const { array } = geometry.getAttribute("metamer");
    const count = "instanceCount" in geometry ? Number(geometry.instanceCount) : 0;
    for (let i = 0; i < count; i += 1) {
      expect(rows.has(array[4 * i]!), `row ${array[4 * i]} is drawn twice`).toBe(false);
      rows.set(array[4 * i]!, array[4 * i + 1]!);
    }
  }
  return rows;
}

/** How many leaves of each row are drawn. */
function leaves(mesh: Mesh): Map<number, number> {
  const counts = new Map<number, number>();
  const { geometry } = mesh;
  const count = "instanceCount" in geometry ? Number(geometry.instanceCount) : 0;
  const leaf = geometry.getAttribute("leaf");
  const tint = geometry.getAttribute("tint");
  for (let i = 0; i < count; i += 1) {
    if (tint.getX(i) >= 0) counts.set(leaf.getX(i), (counts.get(leaf.getX(i)) ?? 0) + 1);
  }
  return counts;
}

it("exactly the living metamers and their leaves are drawn, whatever was changed", () => {
  const random = randoms(31);
  const table = new TreeTable(() => 0);
  const materials = makeMaterials({});
  const branches = new Branches(materials);
  const foliage = new Foliage(materials);
  const sample = sampleTree({ seed: 4, height: 30, orders: 3 });
  table.apply(sample);
  let sequence = sample.sequence;
  for (let round = 0; round < 60; round += 1) {
    const changes: ChunkChange[] = [];
    if (random() < 0.15) {
      const kept = Math.floor(table.rows * (0.6 + 0.4 * random()));
      changes.push({ change: "truncate", rows: kept });
      const chunk = Math.floor(kept / CHUNK_ROWS);
      const start = kept % CHUNK_ROWS;
      const n = Math.min(40, CHUNK_ROWS - start);
      changes.push({
        change: "append",
        chunk,
        generation: 1,
        start,
        rows: {
          parent: Uint32Array.from({ length: n }, () => 2 * (1 + Math.floor(random() * 30)) + (random() < 0.3 ? 1 : 0)),
          position: Int32Array.from({ length: 3 * n }, () => Math.floor(random() * 300)),
          radius: Uint16Array.from({ length: n }, () => 390 + Math.floor(random() * 250)),
          foliage: Uint8Array.from({ length: n }, () => Math.floor(random() * 256)),
          light: new Uint8Array(n),
        },
      });
    } else {
      const rows = Uint8Array.from({ length: 40 }, (_, i) => 1 + 3 * i);
      const head = { change: "patch", chunk: 0, generation: 1, rows } as const;
      changes.push({
        ...head,
        column: "radius",
        values: Uint16Array.from(rows, () => (random() < 0.2 ? 0 : 390 + Math.floor(random() * 250))),
      });
      changes.push({ ...head, column: "foliage", values: Uint8Array.from(rows, () => Math.floor(random() * 256)) });
    }
    sequence += 1;
    table.apply({ epoch: 1, sequence, catchUp: false, changes });
    table.drain(
      (rows) => {
        branches.truncate(rows);
        foliage.truncate(rows);
      },
      (row, bits) => {
        branches.update(table, row);
        if ((bits & Dirty.Shape) !== 0) foliage.update(table, row);
      },
    );
    branches.upload();
    foliage.upload();
    const expected = new Map<number, number>();
    const expectedLeaves = new Map<number, number>();
    for (let row = 0; row < table.rows; row += 1) {
      if (table.parent[row]! < 0 || table.radiusCode[row] === 0) continue;
      expected.set(row, table.parent[row]!);
      const count = table.foliage[row]! & 15;
      if (count > 0) expectedLeaves.set(row, count);
    }
    expect(new Map([...drawn(branches.meshes)].sort((a, b) => a[0] - b[0]))).toEqual(expected);
    expect(new Map([...leaves(foliage.mesh)].sort((a, b) => a[0] - b[0]))).toEqual(expectedLeaves);
  }
});
