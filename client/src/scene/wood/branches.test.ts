import type { InstancedBufferGeometry, InterleavedBufferAttribute, Mesh } from "three";
import { describe, expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { sampleTree } from "../../../test/sample-tree";
import { SMALL, tableOf } from "../../../test/small-tree";
import type { ChunkChange } from "../../wire/frame";
import { CHUNK_ROWS } from "../../wire/generated";
import { Foliage } from "../foliage/foliage";
import { makeMaterials } from "../materials";
import { Painter } from "../painting/painter";
import { TreeTable } from "../table/tree-table";
import { Branches } from "./branches";

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

const wood = (branches: Branches) => branches.meshes.filter((mesh) => mesh !== branches.faces);

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

it("exactly the living metamers and their leaves are drawn, whatever was changed", { timeout: 30_000 }, () => {
  const random = randoms(31);
  const table = new TreeTable(() => 0);
  const materials = makeMaterials({});
  const branches = new Branches(materials);
  const foliage = new Foliage(materials, {}, new Painter());
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
          born: new Uint32Array(n),
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
        foliage.update(table, row, bits);
      },
    );
    branches.upload(table);
    const eye = [40 * random() - 20, 30 * random(), 10 + 200 * random()] as const;
    branches.see(table, { eye, pixels: 900 }, random() < 0.5);
    foliage.upload(table);
    const expected = new Map<number, number>();
    const expectedLeaves = new Map<number, number>();
    for (let row = 0; row < table.rows; row += 1) {
      if (table.parent[row]! < 0 || table.radiusCode[row] === 0) continue;
      expected.set(row, table.parent[row]!);
      const count = table.foliage[row]! & 15;
      if (count > 0) expectedLeaves.set(row, count);
    }
    expect(new Map([...drawn(wood(branches))].sort((a, b) => a[0] - b[0]))).toEqual(expected);
    expect(new Map([...leaves(foliage.meshes[0]!)].sort((a, b) => a[0] - b[0]))).toEqual(expectedLeaves);
  }
});

/** Branches that have taken over a table. */
function branchesOf(table: TreeTable): Branches {
  const branches = new Branches(makeMaterials({}));
  table.drain(
    (rows) => branches.truncate(rows),
    (row) => branches.update(table, row),
  );
  branches.upload(table);
  return branches;
}

/** Triangles that meshes draw. */
function triangles(meshes: Mesh[]): number {
  return meshes.reduce((sum, { geometry }) => {
    const count = "instanceCount" in geometry ? Number(geometry.instanceCount) : 0;
    return sum + (count * geometry.getIndex()!.count) / 3;
  }, 0);
}

describe("branches", { timeout: 30_000 }, () => {
  const large = sampleTree({ seed: 4, height: 90, orders: 5 });

  it("of 100 000 metamers seen whole take less than half a million triangles", () => {
    const table = new TreeTable(() => 0);
    table.apply(large);
    expect(table.rows).toBeGreaterThan(100_000);
    const branches = branchesOf(table);
    branches.see(table, { eye: [0, 45, 190], pixels: 1600 }, true);
    expect(triangles(branches.meshes) * (100_000 / table.rows)).toBeLessThan(500_000);
  });

  it("are rounder from near than from far", () => {
    const table = new TreeTable(() => 0);
    table.apply(sampleTree({ seed: 4, height: 30, orders: 3 }));
    const branches = branchesOf(table);
    branches.see(table, { eye: [0, 15, 400], pixels: 1000 }, true);
    const far = triangles(branches.meshes);
    branches.see(table, { eye: [0, 3, 5], pixels: 1000 }, true);
    expect(triangles(branches.meshes)).toBeGreaterThan(5 * far);
  });

  it("are looked at a few a frame, until all have been", () => {
    const [table, other] = [new TreeTable(() => 0), new TreeTable(() => 0)];
    for (const each of [table, other]) each.apply(large);
    const [branches, atOnce] = [branchesOf(table), branchesOf(other)];
    const onlooker = { eye: [0, 20, 30], pixels: 1000 } as const;
    let frames = 1;
    while (branches.see(table, onlooker, false)) frames += 1;
    expect(frames).toBeGreaterThan(3);
    atOnce.see(other, onlooker, true);
    expect(triangles(branches.meshes)).toBe(triangles(atOnce.meshes));
    expect(branches.see(table, onlooker, false)).toBe(false);
  });

  it("overlap exactly where an axis passes from one level to another", () => {
    const table = new TreeTable(() => 0);
    table.apply(sampleTree({ seed: 4, height: 30, orders: 3 }));
    const branches = branchesOf(table);
    for (const eye of [
      [0, 3, 5],
      [10, 20, 40],
      [0, 12, 9],
    ] as const) {
      branches.see(table, { eye, pixels: 1000 }, true);
      const level = new Map(wood(branches).flatMap((mesh, i) => [...drawn([mesh]).keys()].map((row) => [row, i])));
      let joints = 0;
      for (const { geometry } of wood(branches)) {
        const { array } = geometry.getAttribute("metamer");
        for (let i = 0; i < Number((geometry as unknown as { instanceCount: number }).instanceCount); i += 1) {
          const [row, parent, flags] = [array[4 * i]!, array[4 * i + 1]!, array[4 * i + 3]!];
          const passes = table.limbs.begins[row] === 0 && level.has(parent) && level.get(parent) !== level.get(row);
          expect((flags & 16) !== 0, `row ${row}`).toBe(passes);
          if (passes) joints += 1;
        }
      }
      expect(joints).toBeGreaterThan(5);
    }
  });

  it("show a cut face only where a thick one ends", () => {
    const faces = (table: TreeTable) => [...drawn([branchesOf(table).faces]).keys()];
    expect(faces(tableOf(SMALL.map((twig, row) => (row > 4 ? twig : { ...twig, radius: 0.5 }))))).toEqual([5, 9]);
    const pruned = tableOf(SMALL.map((twig, row) => (row === 4 || row === 5 ? { ...twig, dead: true } : twig)));
    expect(faces(pruned)).toEqual([3, 9]);
    expect(faces(tableOf(SMALL.map((twig) => ({ ...twig, radius: 0.1 }))))).toEqual([]);
  });

  it("show the same cut faces however the tree came to be so", () => {
    const thick = (radius: number) => tableOf(SMALL.map((twig, row) => (row > 9 ? { ...twig, radius } : twig)));
    const faces = (branches: Branches) => [...drawn([branches.faces]).keys()].sort((a, b) => a - b);
    const cut = (branches: Branches) =>
      wood(branches).flatMap(({ geometry }) => {
        const { array } = geometry.getAttribute("metamer");
        const count = (geometry as InstancedBufferGeometry).instanceCount;
        return Array.from({ length: count }, (_, i) => i).flatMap((i) =>
          array[4 * i + 3]! & 8 ? [array[4 * i]!] : [],
        );
      });
    for (const [before, after] of [
      [0.07, 0.3],
      [0.3, 0.07],
      [0.07, 0.1],
    ] as const) {
      const table = thick(before);
      const branches = branchesOf(table);
      tableOf(
        SMALL.map((twig, row) => (row > 9 ? { ...twig, radius: after } : twig)),
        table,
      );
      table.drain(
        (rows) => branches.truncate(rows),
        (row) => branches.update(table, row),
      );
      branches.upload(table);
      const fresh = branchesOf(thick(after));
      expect(faces(branches), `from ${before} to ${after}`).toEqual(faces(fresh));
      expect(cut(branches).sort()).toEqual(cut(fresh).sort());
    }
    expect(faces(branchesOf(thick(0.3)))).toEqual([]);
  });

  it("show none where a lateral goes on in place of what was cut", () => {
    const cutAbove = (heir: number) =>
      tableOf(
        SMALL.map((twig, row) => {
          if (row === 4 || row === 5) return { ...twig, dead: true };
          return row >= 12 ? { ...twig, radius: heir } : twig;
        }),
      );
    const table = cutAbove(0.4);
    const branches = branchesOf(table);
    expect([...drawn([branches.faces]).keys()]).not.toContain(3);
    // It is cut as well, and a stub is left.
    const patch = { change: "patch", chunk: 0, generation: 2, column: "radius" } as const;
    const changes = [{ ...patch, rows: Uint8Array.of(12, 13), values: Uint16Array.of(0, 0) }];
    table.apply({ epoch: 1, sequence: 2, catchUp: true, changes });
    table.drain(
      () => undefined,
      (row) => branches.update(table, row),
    );
    branches.upload(table);
    expect([...drawn([branches.faces]).keys()]).toContain(3);
    expect([...drawn([branchesOf(cutAbove(0.2)).faces]).keys()], "a slim one does not").toContain(3);
  });
});

it("wood and leaves that change while they are hidden are uploaded with what changes later", () => {
  const table = new TreeTable(() => 0);
  const sample = sampleTree({ seed: 4, height: 30, orders: 3 });
  table.apply(sample);
  const branches = branchesOf(table);
  const foliage = new Foliage(makeMaterials({}), {}, new Painter());
  const follow = () => {
    table.drain(
      () => undefined,
      (row, bits) => {
        branches.update(table, row);
        foliage.update(table, row, bits);
      },
    );
    branches.upload(table);
    foliage.upload(table);
  };
  for (let row = 0; row < table.rows; row += 1) foliage.update(table, row, 2);
  foliage.upload(table);
  const leaf = (foliage.meshes[0]!.geometry.getAttribute("leaf") as InterleavedBufferAttribute).data;
  // As three.js does once it has uploaded a buffer.
  leaf.clearUpdateRanges();
  const chunk = { change: "patch", chunk: 0, generation: 2, column: "foliage" } as const;
  const changed = [table.rows > CHUNK_ROWS ? 200 : 20, 10];
  const places: number[] = [];
  for (const [i, row] of changed.entries()) {
    const changes = [{ ...chunk, rows: Uint8Array.of(row), values: Uint8Array.of(0x13 + i) }];
    table.apply({ epoch: 1, sequence: sample.sequence + 1 + i, catchUp: false, changes });
    follow();
    for (let at = 0; at < leaf.array.length; at += 5) if (leaf.array[at] === row) places.push(at);
  }
  expect(places.length).toBeGreaterThan(4);
  const waits = (at: number) => leaf.updateRanges.some(({ start, count }) => start <= at && at < start + count);
  expect(places.filter((at) => !waits(at))).toEqual([]);
});
