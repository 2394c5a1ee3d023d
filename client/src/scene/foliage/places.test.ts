import { readFileSync } from "node:fs";
import { expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { chanceOf, isBearing, isChosen, isPlace, type Placing } from "./places";

const table = new PlainTable(() => 0);
table.apply(sampleTree({ seed: 5, height: 30, orders: 3 }));
const ALL: Placing = { share: 1, place: "twigs", vigor: 0 };

function bearing(placing: Placing, salt = 1): number[] {
  return Array.from({ length: table.rows }, (_, row) => row).filter((row) => isBearing(table, row, placing, salt));
}

it("tips, leafy twigs and bare wood are distinguished", () => {
  const rows = (place: Placing["place"]) =>
    Array.from({ length: table.rows }, (_, row) => row).filter((row) => isPlace(table, row, place));
  const [tips, twigs, wood] = [rows("tips"), rows("twigs"), rows("wood")];
  expect(Math.min(tips.length, twigs.length, wood.length)).toBeGreaterThan(20);
  for (const row of tips) expect(table.successor[row]).toBe(-1);
  for (const row of twigs) expect(table.foliage[row]! & 15).toBeGreaterThan(0);
  const leafy = new Set(twigs);
  for (const row of wood) expect(leafy.has(row)).toBe(false);
  expect(rows("tips").concat(twigs, wood)).not.toContain(0);
});

it("a larger share keeps every flower and adds to them", () => {
  let before: number[] = [];
  for (const share of [0, 0.1, 0.35, 0.7, 1]) {
    const now = bearing({ ...ALL, share });
    expect(now).toEqual(expect.arrayContaining(before));
    before = now;
  }
  expect(bearing({ ...ALL, share: 0 })).toEqual([]);
  expect(before).toEqual(
    Array.from({ length: table.rows }, (_, row) => row).filter((row) => isPlace(table, row, "twigs")),
  );
});

it("a share is that share of the places", () => {
  const places = bearing(ALL).length;
  expect(bearing({ ...ALL, share: 0.3 }).length / places).toBeGreaterThan(0.2);
  expect(bearing({ ...ALL, share: 0.3 }).length / places).toBeLessThan(0.4);
});

it("flowers and fruits choose places of their own", () => {
  const placing = { ...ALL, share: 0.3 };
  expect(bearing(placing, 1)).toEqual(bearing(placing, 1));
  expect(bearing(placing, 1)).not.toEqual(bearing(placing, 2));
});

it("vigor favours strong shoots, or weak ones", () => {
  const mean = (rows: number[]) => rows.reduce((sum, row) => sum + (table.foliage[row]! >> 4), 0) / rows.length;
  const share = 0.3;
  const even = mean(bearing({ ...ALL, share }));
  expect(mean(bearing({ ...ALL, share, vigor: 1 }))).toBeGreaterThan(even + 0.5);
  expect(mean(bearing({ ...ALL, share, vigor: -1 }))).toBeLessThan(even - 0.5);
  expect(chanceOf({ ...ALL, share: 0.5, vigor: 1 }, 0)).toBe(0);
  expect(chanceOf({ ...ALL, share: 0.5, vigor: 1 }, 15)).toBe(1);
  expect(chanceOf({ ...ALL, share: 0.5, vigor: 0 }, 9)).toBe(0.5);
});

it("the dead and the seed bear nothing", () => {
  const frame = sampleTree({ seed: 5, height: 12, orders: 2 });
  const dead = new PlainTable(() => 0);
  dead.apply(frame);
  dead.apply({
    epoch: 1,
    sequence: 2,
    catchUp: false,
    changes: [
      {
        change: "patch",
        chunk: 0,
        generation: 2,
        column: "radius",
        rows: Uint8Array.from({ length: dead.rows < 256 ? dead.rows : 256 }, (_, i) => i),
        values: new Int32Array(dead.rows < 256 ? dead.rows : 256),
      },
    ],
  });
  for (let row = 0; row < Math.min(256, dead.rows); row += 1) {
    for (const place of ["tips", "twigs", "wood"] as const) expect(isPlace(dead, row, place)).toBe(false);
  }
});

it("the server's exports choose the same places", () => {
  const file = new URL("../../../../server/export/golden/ornaments.json", import.meta.url);
  const { places }: { places: { share: number; vigor: number; salt: number; rows: number[] }[] } = JSON.parse(
    readFileSync(file, "utf8"),
  );
  const all = Array.from({ length: Math.ceil(4_000_000 / 20_011) }, (_, i) => 20_011 * i);
  for (const { salt, rows, ...placing } of places) {
    expect(all.filter((row) => isChosen(row, row % 16, placing, salt))).toEqual(rows);
  }
});
