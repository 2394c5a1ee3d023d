import { expect, it } from "vitest";
import { checksumOf } from "./checksum";

/** Rows as parent, begins axis, x, y, z, radius, foliage, light, born. */
function tableOf(rows: readonly (readonly number[])[]) {
  const column = (at: number) => rows.map((row) => row[at]!);
  return {
    rows: rows.length,
    parent: Int32Array.from(column(0)),
    startsAxis: Uint8Array.from(column(1)),
    quantised: Int32Array.from(rows.flatMap((row) => row.slice(2, 5))),
    radiusCode: Uint16Array.from(column(5)),
    foliage: Uint8Array.from(column(6)),
    light: Uint8Array.from(column(7)),
    born: Uint32Array.from(column(8)),
    organs: new Map<number, Uint32Array>(),
  };
}

const ROWS = [
  [-1, 0, 0, 0, 0, 0, 0, 255, 0],
  [0, 0, 0, 256, 0, 231, 0x35, 200, 1],
  [1, 1, -120, 400, 77, 101, 0xf3, 17, 2],
  // More than a chunk, each on the one before it.
  ...Array.from({ length: 299 }, (_, i) => {
    const k = i + 1;
    const radius = k % 7 === 0 ? 0 : 90;
    return [k + 1, 0, 3 * k - 120, 400 + 200 * k, 77 - k, radius, k % 256, (k * 5) % 256, 3 + Math.floor(k / 4)];
  }),
];

it("CK1: rows add up to what zlib makes of the bytes that the protocol says", () => {
  // zlib.crc32 of struct.pack("<IiiiHBBI", link, x, y, z, radius, foliage, light, born) of each row in Python,
  // with foliage and light 0 where the radius is.
  expect(checksumOf(tableOf(ROWS.slice(0, 3)))).toBe(2551646140);
  expect(checksumOf(tableOf(ROWS))).toBe(202980415);
  expect(checksumOf(tableOf([]))).toBe(0);
});

it("CK1: each number of each row counts", () => {
  const sums = new Set([checksumOf(tableOf(ROWS))]);
  for (let at = 1; at < 9; at++) {
    const changed = ROWS.map((row, i) => (i === 200 ? row.map((value, j) => (j === at ? value ^ 1 : value)) : row));
    sums.add(checksumOf(tableOf(changed)));
  }
  expect(sums.size).toBe(9);
});

it("CK1: organs of rows that are drawn count, in the order of the rows", () => {
  // The same with struct.pack("<IBI", 1, 1, 0x8a400317) + struct.pack("<IB", 2, 0) behind the rows.
  const table = tableOf(ROWS.slice(0, 3));
  table.organs.set(2, new Uint32Array(0)).set(1, Uint32Array.of(0x8a400317)).set(0, Uint32Array.of(5));
  expect(checksumOf(table)).toBe(13623858);
});
