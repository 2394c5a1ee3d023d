import { ByteReader } from "./bytes";
import { openFrame } from "./envelope";
import { FrameError } from "./frame-error";
import { CHUNK_ROWS, FrameKind } from "./generated";

export { FrameError } from "./frame-error";

/** One change to the table of rows; mirrors `proto/src/frame.rs`. */
export interface Frame {
  epoch: number;
  sequence: number;
  catchUp: boolean;
  changes: ChunkChange[];
}

/** A change to the table of rows. */
export type ChunkChange =
  | { change: "truncate"; rows: number }
  | { change: "replace"; chunk: number; generation: number; rows: Rows }
  | { change: "append"; chunk: number; generation: number; start: number; rows: Rows }
  | ({ change: "patch"; chunk: number; generation: number; rows: Uint8Array } & Values);

/** Whole rows, column by column. */
export interface Rows {
  /** 0 for a seed, else 2·(row − parent's row) + (1 if it begins an axis). */
  parent: Uint32Array;
  /** Differences to the parent's position, x y z interleaved, in 1/256 internode. */
  position: Int32Array;
  /** Radius codes; 0 is dead. */
  radius: Uint16Array;
  /** Leaves in the low four bits, vigor in the high four. */
  foliage: Uint8Array;
  /** Exposure 0 to 255. */
  light: Uint8Array;
  /** Steps of growth up to its birth, that in which it was born included. */
  born: Uint32Array;
}

/** Organs that rows are given, each in one number (LF5); null where a row bears what grows on such wood. */
export type OrganRows = readonly (Uint32Array | null)[];

/** Values of one column, encoded as in `Rows`. */
export type Values =
  | { [C in keyof Rows]: { column: C; values: Rows[C] } }[keyof Rows]
  | { column: "organs"; values: OrganRows };

const CATCH_UP = 1;
/** Organs of one row at most. */
const MOST_ORGANS = 15;
/** The parent of a row that goes on where the row before it ends. */
const NEXT = 2;

/** Reads a mesh delta; any bytes at all give a frame or a `FrameError` (FR1–FR3). */
export async function decodeFrame(bytes: ArrayBuffer): Promise<Frame> {
  const { epoch, sequence, flags, body } = await openFrame(bytes, FrameKind.MeshDelta);
  return { epoch, sequence, catchUp: (flags & CATCH_UP) !== 0, changes: readChanges(body, sequence) };
}

/** A body that is a list of changes, of a frame with this sequence. */
export function readChanges(body: Uint8Array, sequence: number): ChunkChange[] {
  const reader = new ByteReader(body);
  const changes: ChunkChange[] = [];
  while (!reader.done) changes.push(readChange(reader, sequence));
  return changes;
}

function readChange(reader: ByteReader, sequence: number): ChunkChange {
  const kind = reader.byte();
  if (kind < 1 || kind > 4) throw new FrameError(`Change ${kind} is unknown.`);
  const first = reader.varint();
  if (kind === 1) return { change: "truncate", rows: first };
  const chunk = first;
  const generation = (sequence - reader.varint()) >>> 0;
  if (kind === 2) return { change: "replace", chunk, generation, rows: readRows(reader) };
  if (kind === 3) {
    const start = reader.varint();
    const rows = readRows(reader);
    if (start + rows.parent.length > CHUNK_ROWS) throw new FrameError("An append runs past the end of its chunk.");
    return { change: "append", chunk, generation, start, rows };
  }
  const column = reader.byte();
  const rows = readGaps(reader, readCount(reader));
  return { change: "patch", chunk, generation, rows, ...readValues(reader, column, rows.length) };
}

function readCount(reader: ByteReader): number {
  const count = reader.varint();
  if (count < 1 || count > CHUNK_ROWS) throw new FrameError(`A count of ${count} is not 1 to ${CHUNK_ROWS}.`);
  return count;
}

function readGaps(reader: ByteReader, count: number): Uint8Array {
  const rows = new Uint8Array(count);
  let next = 0;
  for (let i = 0; i < count; i += 1) {
    const row = next + reader.varint();
    if (row >= CHUNK_ROWS) throw new FrameError("A patch runs past the end of its chunk.");
    rows[i] = row;
    next = row + 1;
  }
  return rows;
}

function readRows(reader: ByteReader): Rows {
  const count = readCount(reader);
  const parent = readVarints(reader, count);
  return {
    parent,
    position: likeBefore(parent, readPositions(reader, count)),
    radius: readRadii(reader, count),
    foliage: readBytes(reader, count),
    light: readBytes(reader, count),
    born: readBirths(reader, count),
  };
}

function readValues(reader: ByteReader, column: number, count: number): Values {
  switch (column) {
    case 0:
      return { column: "parent", values: readVarints(reader, count) };
    case 1:
      return { column: "position", values: readPositions(reader, count) };
    case 2:
      return { column: "radius", values: readRadii(reader, count) };
    case 3:
      return { column: "foliage", values: readBytes(reader, count) };
    case 4:
      return { column: "light", values: readBytes(reader, count) };
    case 5:
      return { column: "born", values: readBirths(reader, count) };
    case 6:
      return { column: "organs", values: Array.from({ length: count }, () => readOrgans(reader)) };
    default:
      throw new FrameError(`Column ${column} is unknown.`);
  }
}

function readOrgans(reader: ByteReader): Uint32Array | null {
  const count = reader.byte() - 1;
  if (count < 0) return null;
  const organs = new Uint32Array(count);
  for (let i = 0; i < count; i += 1) {
    const [a, b, c, d] = reader.take(4) as unknown as [number, number, number, number];
    organs[i] = (a | (b << 8) | (c << 16) | (d << 24)) >>> 0;
  }
  if (count > MOST_ORGANS || organs.some((organ) => organ >>> 30 === 3)) throw new FrameError("Organs cannot be read.");
  return organs;
}

function readVarints(reader: ByteReader, count: number): Uint32Array {
  const values = new Uint32Array(count);
  for (let i = 0; i < count; i += 1) values[i] = reader.varint();
  return values;
}

/** A row that goes on where the row before it ends travels as the difference to how that one went. */
function likeBefore(parent: Uint32Array, values: Int32Array): Int32Array {
  for (let i = 1; i < parent.length; i += 1) {
    if (parent[i] !== NEXT) continue;
    for (let axis = 3 * i; axis < 3 * i + 3; axis += 1) values[axis] = values[axis]! + values[axis - 3]!;
  }
  return values;
}

/** Each travels as the difference to the one before it, modulo 256. */
function readBytes(reader: ByteReader, count: number): Uint8Array {
  const values = reader.take(count);
  for (let i = 1; i < count; i += 1) values[i] = values[i]! + values[i - 1]!;
  return values;
}

/** Each travels as the difference to the one before it. */
function readBirths(reader: ByteReader, count: number): Uint32Array {
  const values = new Uint32Array(count);
  let born = 0;
  for (let i = 0; i < count; i += 1) {
    born = (born + reader.varint()) >>> 0;
    values[i] = born;
  }
  return values;
}

/** Each travels as the difference to the one before it. */
function readRadii(reader: ByteReader, count: number): Uint16Array {
  const values = new Uint16Array(count);
  let code = 0;
  for (let i = 0; i < count; i += 1) {
    code += reader.zigzag();
    if (code < 0 || code > 0xffff) throw new FrameError(`A radius code of ${code} has not 16 bits.`);
    values[i] = code;
  }
  return values;
}

/** All x, then all y, then all z on the wire; interleaved here. */
function readPositions(reader: ByteReader, count: number): Int32Array {
  const values = new Int32Array(3 * count);
  for (let axis = 0; axis < 3; axis += 1) {
    for (let i = 0; i < count; i += 1) values[3 * i + axis] = reader.zigzag();
  }
  return values;
}
