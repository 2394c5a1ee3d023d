import type { Mesh } from "three";
import { describe, expect, it } from "vitest";
import { idlePainter } from "../../../test/idle-painter";
import { borneOf, itemsOf, textureOf, trianglesOf } from "../../../test/items";
import { PlainTable } from "../../../test/plain-table";
import { randoms } from "../../../test/randoms";
import { sampleTree } from "../../../test/sample-tree";
import { SMALL, tableOf } from "../../../test/small-tree";
import type { ChunkChange } from "../../wire/frame";
import { CHUNK_ROWS } from "../../wire/generated";
import { Foliage } from "../foliage/foliage";
import { makeMaterials } from "../materials";
import type { TreeTable } from "../table/tree-table";
import { Branches } from "./branches";

/** Every row that instances of these meshes draw, with its parent. */
function drawn(meshes: Mesh[]): Map<number, number> {
  const rows = new Map<number, number>();
  for (const [row, parent] of meshes.flatMap((mesh) => itemsOf(mesh, 4))) {
    expect(rows.has(row!), `row ${row} is drawn twice`).toBe(false);
    rows.set(row!, parent!);
  }
  return rows;
}

const wood = (branches: Branches) =>
  branches.meshes.filter((mesh) => mesh !== branches.faces && mesh !== branches.roots);

it("names every material that wood is drawn with, for shaders that come later", () => {
  const materials = makeMaterials({});
  const branches = new Branches(materials);
  expect(branches.materials).toHaveLength(branches.meshes.length);
  for (const { material } of branches.meshes) {
    expect(branches.materials).toContain(material);
    expect([materials.bark, materials.twig]).not.toContain(material);
  }
});

it("exactly the living metamers and their leaves are drawn, whatever was changed", { timeout: 30_000 }, () => {
  const random = randoms(31);
  const table = new PlainTable(() => 0);
  const materials = makeMaterials({});
  const branches = new Branches(materials);
  const foliage = new Foliage(materials, {}, idlePainter());
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
        values: Int32Array.from(rows, () => (random() < 0.2 ? 0 : 390 + Math.floor(random() * 250))),
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
    expect(borneOf(foliage.meshes[0]!)).toEqual(expectedLeaves);
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

describe("branches", { timeout: 30_000 }, () => {
  const large = sampleTree({ seed: 4, height: 90, orders: 5 });

  it("of 100 000 metamers seen whole take less than half a million triangles", () => {
    const table = new PlainTable(() => 0);
    table.apply(large);
    expect(table.rows).toBeGreaterThan(100_000);
    const branches = branchesOf(table);
    branches.see(table, { eye: [0, 45, 190], pixels: 1600 }, true);
    expect(trianglesOf(branches.meshes) * (100_000 / table.rows)).toBeLessThan(500_000);
  });

  it("are rounder from near than from far", () => {
    const table = new PlainTable(() => 0);
    table.apply(sampleTree({ seed: 4, height: 30, orders: 3 }));
    const branches = branchesOf(table);
    branches.see(table, { eye: [0, 15, 400], pixels: 1000 }, true);
    const far = trianglesOf(branches.meshes);
    branches.see(table, { eye: [0, 3, 5], pixels: 1000 }, true);
    expect(trianglesOf(branches.meshes)).toBeGreaterThan(5 * far);
  });

  it("are looked at a few a frame, until all have been", () => {
    const [table, other] = [new PlainTable(() => 0), new PlainTable(() => 0)];
    for (const each of [table, other]) each.apply(large);
    const [branches, atOnce] = [branchesOf(table), branchesOf(other)];
    const onlooker = { eye: [0, 20, 30], pixels: 1000 } as const;
    let frames = 1;
    while (branches.see(table, onlooker, false)) frames += 1;
    expect(frames).toBeGreaterThan(3);
    atOnce.see(other, onlooker, true);
    expect(trianglesOf(branches.meshes)).toBe(trianglesOf(atOnce.meshes));
    expect(branches.see(table, onlooker, false)).toBe(false);
  });

  it("overlap exactly where an axis passes from one level to another", () => {
    const table = new PlainTable(() => 0);
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
      for (const [row, parent, , flags] of wood(branches).flatMap((mesh) => itemsOf(mesh, 4))) {
        const passes = table.limbs.begins[row!] === 0 && level.has(parent!) && level.get(parent!) !== level.get(row!);
        expect((flags! & 16) !== 0, `row ${row}`).toBe(passes);
        if (passes) joints += 1;
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
      wood(branches)
        .flatMap((mesh) => itemsOf(mesh, 4))
        .flatMap(([row, , , flags]) => (flags! & 8 ? [row!] : []));
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
    const changes = [{ ...patch, rows: Uint8Array.of(12, 13), values: Int32Array.of(0, 0) }];
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
  const table = new PlainTable(() => 0);
  const sample = sampleTree({ seed: 4, height: 30, orders: 3 });
  table.apply(sample);
  const branches = branchesOf(table);
  const foliage = new Foliage(makeMaterials({}), {}, idlePainter());
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
  const leaf = textureOf(foliage.meshes[0]!);
  const leafNumbers = leaf.image.data as unknown as Float32Array;
  // As three.js does once it has uploaded a texture.
  leaf.clearUpdateRanges();
  leaf.onUpdate?.(leaf);
  const chunk = { change: "patch", chunk: 0, generation: 2, column: "foliage" } as const;
  const changed = [table.rows > CHUNK_ROWS ? 200 : 20, 10];
  const places: number[] = [];
  for (const [i, row] of changed.entries()) {
    const changes = [{ ...chunk, rows: Uint8Array.of(row), values: Uint8Array.of(0x13 + i) }];
    table.apply({ epoch: 1, sequence: sample.sequence + 1 + i, catchUp: false, changes });
    follow();
    for (let at = 0; at < leafNumbers.length; at += 8) if (leafNumbers[at] === row) places.push(at);
  }
  expect(places.length).toBeGreaterThan(4);
  const waits = (at: number) => leaf.updateRanges.some(({ start, count }) => start <= at && at < start + count);
  expect(places.filter((at) => !waits(at))).toEqual([]);
});
