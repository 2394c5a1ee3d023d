import { CHUNK_ROWS } from "../../wire/generated";

/** The columns of a table that count. */
export interface Summed {
  readonly rows: number;
  readonly parent: Int32Array;
  readonly startsAxis: Uint8Array;
  readonly quantised: Int32Array;
  readonly radiusCode: Uint16Array;
  readonly foliage: Uint8Array;
  readonly light: Uint8Array;
  readonly born: Uint32Array;
  readonly organs: ReadonlyMap<number, Uint32Array>;
}

/** Bytes of a row in the sum. */
const ROW_BYTES = 24;
/** CRC-32's polynomial, its bits reversed. */
const POLYNOMIAL = 0xedb88320;

const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? POLYNOMIAL : 0);
  return crc;
});

/** CRC-32 of all rows in their order, which a server's `checksum` is compared with (CK1). */
export function checksumOf(table: Summed): number {
  const bytes = new Uint8Array(ROW_BYTES * CHUNK_ROWS);
  const view = new DataView(bytes.buffer);
  let crc = 0xffffffff;
  for (let first = 0; first < table.rows; first += CHUNK_ROWS) {
    const last = Math.min(table.rows, first + CHUNK_ROWS);
    for (let row = first; row < last; row++) write(table, row, view, (row - first) * ROW_BYTES);
    crc = summed(crc, bytes.subarray(0, (last - first) * ROW_BYTES));
  }
  const bearing = [...table.organs.keys()].filter((row) => table.radiusCode[row] !== 0);
  for (const row of bearing.sort((a, b) => a - b)) crc = summed(crc, organBytes(row, table.organs.get(row)!));
  return (crc ^ 0xffffffff) >>> 0;
}

function summed(crc: number, bytes: Uint8Array): number {
  let sum = crc;
  for (const byte of bytes) sum = (sum >>> 8) ^ TABLE[(sum ^ byte) & 0xff]!;
  return sum;
}

/** A row's number, how many organs it is given, and their numbers. */
function organBytes(row: number, organs: Uint32Array): Uint8Array {
  const bytes = new Uint8Array(5 + 4 * organs.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, row, true);
  view.setUint8(4, organs.length);
  for (const [i, organ] of organs.entries()) view.setUint32(5 + 4 * i, organ, true);
  return bytes;
}

function write(table: Summed, row: number, view: DataView, at: number): void {
  const parent = table.parent[row]!;
  view.setUint32(at, parent < 0 ? 0 : 2 * (row - parent) + table.startsAxis[row]!, true);
  for (let axis = 0; axis < 3; axis++) view.setInt32(at + 4 + 4 * axis, table.quantised[3 * row + axis]!, true);
  view.setUint16(at + 16, table.radiusCode[row]!, true);
  // What is not drawn looks as it did when it was, which nobody knows who has not seen it.
  const isDrawn = table.radiusCode[row] !== 0;
  view.setUint8(at + 18, isDrawn ? table.foliage[row]! : 0);
  view.setUint8(at + 19, isDrawn ? table.light[row]! : 0);
  view.setUint32(at + 20, table.born[row]!, true);
}
