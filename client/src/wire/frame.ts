import { ByteReader } from "./bytes";
import { openFrame } from "./envelope";
import { FrameError } from "./frame-error";
import { CHUNK_ROWS, FrameKind, MOST_ORGANS } from "./generated";
import { Field } from "./generated-models";
import type { FieldNumber, NumberSource } from "./numbers";
import { Unpacker } from "./unpacker";

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
  /** What is told of each position (FR10), three numbers a row. */
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

/** Values of one column; of radius, foliage and light by how much they change (FR11), of others as in `Rows`. */
export type Values =
  | { column: "parent" | "born"; values: Uint32Array }
  | { column: "position" | "radius" | "light"; values: Int32Array }
  | { column: "foliage"; values: Uint8Array }
  | { column: "organs"; values: OrganRows };

const CATCH_UP = 1;
/** Reads a mesh delta; any bytes at all give a frame or a `FrameError` (FR1–FR3, FR9). */
export async function decodeFrame(bytes: ArrayBuffer): Promise<Frame> {
  const { epoch, sequence, flags, body, isPacked } = await openFrame(bytes, FrameKind.MeshDelta);
  const changes = isPacked ? unpackChanges(body, sequence) : readChanges(body, sequence);
  return { epoch, sequence, catchUp: (flags & CATCH_UP) !== 0, changes };
}

/** A body that is a list of changes, of a frame with this sequence. */
export function readChanges(body: Uint8Array, sequence: number): ChunkChange[] {
  return changesOf(new ByteReader(body), sequence);
}

function unpackChanges(body: Uint8Array, sequence: number): ChunkChange[] {
  const unpacker = new Unpacker(body);
  const changes = changesOf(unpacker, sequence);
  unpacker.end();
  return changes;
}

/** What the kind of the next change depends on: the kind of the last. */
const AFTER = [
  Field.FirstChange,
  Field.ChangeAfterTruncate,
  Field.ChangeAfterReplace,
  Field.ChangeAfterAppend,
  Field.ChangeAfterPatch,
] as const;

function changesOf(source: NumberSource, sequence: number): ChunkChange[] {
  const changes: ChunkChange[] = [];
  let chunk: number | null = null;
  let last = 0;
  for (;;) {
    const kind = source.change(AFTER[last]!);
    if (kind === null) return changes;
    if (kind < 1 || kind > 4) throw new FrameError(`Change ${kind} is unknown.`);
    last = kind;
    if (kind === 1) {
      changes.push({ change: "truncate", rows: source.number(Field.Truncate) });
      continue;
    }
    // Each as the difference to the one before it.
    chunk = chunk === null ? source.number(Field.FirstChunk) : (chunk + zigzag(source, Field.Chunk)) >>> 0;
    const generation = (sequence - source.number(Field.Age)) >>> 0;
    changes.push(readChange(source, kind, chunk, generation));
  }
}

function readChange(source: NumberSource, kind: number, chunk: number, generation: number): ChunkChange {
  if (kind === 2) return { change: "replace", chunk, generation, rows: readRows(source) };
  if (kind === 3) {
    const start = source.number(Field.Start);
    const rows = readRows(source);
    if (start + rows.parent.length > CHUNK_ROWS) throw new FrameError("An append runs past the end of its chunk.");
    return { change: "append", chunk, generation, start, rows };
  }
  const column = source.number(Field.Column);
  const rows = readGaps(source, PATCHED[column] ?? OTHERS);
  return { change: "patch", chunk, generation, rows, ...readValues(source, column, rows) };
}

/** Fields of the rows that a patch names: how many, and rows skipped before the first, behind none, behind some. */
type Patched = readonly [count: FieldNumber, first: FieldNumber, afterNone: FieldNumber, other: FieldNumber];

const OTHERS: Patched = [Field.OtherCount, Field.OtherGap, Field.OtherGap, Field.OtherGap];
const PATCHED: readonly Patched[] = [
  OTHERS,
  OTHERS,
  [Field.RadiusCount, Field.FirstRadiusGap, Field.RadiusGapAfterNone, Field.RadiusGap],
  [Field.FoliageCount, Field.FirstFoliageGap, Field.FoliageGapAfterNone, Field.FoliageGap],
  [Field.LightCount, Field.FirstLightGap, Field.LightGapAfterNone, Field.LightGap],
];

/** Fields of values that stand one after the other: of the first, of any other. */
type Fields = readonly [first: FieldNumber, other: FieldNumber];

const FOLIAGE: Fields = [Field.FirstFoliage, Field.Foliage];
const LIGHT: Fields = [Field.FirstLight, Field.Light];
const BORN: Fields = [Field.FirstBorn, Field.Born];
const NEW_NUMBERS: Fields = [Field.NewNumber, Field.NewNumber];

/** The signed integer that zigzag mapped to an unsigned one (FR3). */
function zigzag(source: NumberSource, field: FieldNumber): number {
  const value = source.number(field);
  return (value >>> 1) ^ -(value & 1);
}

function readCount(source: NumberSource, field: FieldNumber): number {
  const count = source.number(field);
  if (count < 1 || count > CHUNK_ROWS) throw new FrameError(`A count of ${count} is not 1 to ${CHUNK_ROWS}.`);
  return count;
}

function readGaps(source: NumberSource, [count, first, afterNone, other]: Patched): Uint8Array {
  const rows = new Uint8Array(readCount(source, count));
  let next = 0;
  let field = first;
  for (let i = 0; i < rows.length; i += 1) {
    const skipped = source.number(field);
    const row = next + skipped;
    if (row >= CHUNK_ROWS) throw new FrameError("A patch runs past the end of its chunk.");
    rows[i] = row;
    field = skipped === 0 ? afterNone : other;
    next = row + 1;
  }
  return rows;
}

function readRows(source: NumberSource): Rows {
  const count = readCount(source, Field.Count);
  const parent = new Uint32Array(count);
  for (let i = 0; i < count; i += 1) parent[i] = source.number(i === 0 ? Field.FirstParent : Field.Parent);
  return {
    parent,
    position: readPositions(source, count, (i, part) =>
      parent[i]! & 1 ? (part === 2 ? Field.Along : Field.Across) : part === 2 ? Field.OnAlong : Field.OnAcross,
    ),
    radius: readRadii(source, count),
    foliage: readBytes(source, FOLIAGE, count),
    light: readBytes(source, LIGHT, count),
    born: readBirths(source, BORN, count),
  };
}

function readValues(source: NumberSource, column: number, rows: Uint8Array): Values {
  const count = rows.length;
  switch (column) {
    case 0:
      return { column: "parent", values: Uint32Array.from(rows, () => source.number(Field.NewNumber)) };
    case 1:
      return { column: "position", values: readPositions(source, count, () => Field.NewPosition) };
    case 2:
      return { column: "radius", values: Int32Array.from(rows, () => zigzag(source, Field.NewRadius)) };
    case 3:
      return { column: "foliage", values: Uint8Array.from(rows, () => source.byte(Field.NewFoliage)) };
    case 4:
      return { column: "light", values: Int32Array.from(rows, () => zigzag(source, Field.NewLight)) };
    case 5:
      return { column: "born", values: readBirths(source, NEW_NUMBERS, count) };
    case 6:
      return { column: "organs", values: Array.from(rows, () => readOrgans(source)) };
    default:
      throw new FrameError(`Column ${column} is unknown.`);
  }
}

function readOrgans(source: NumberSource): Uint32Array | null {
  const count = source.byte(Field.Organs) - 1;
  if (count < 0) return null;
  if (count > MOST_ORGANS) throw new FrameError("Organs cannot be read.");
  const organs = new Uint32Array(count);
  for (let i = 0; i < count; i += 1) {
    for (let place = 0; place < 32; place += 8) organs[i] = organs[i]! | (source.byte(Field.Organ) << place);
  }
  if (organs.some((organ) => organ >>> 30 === 3)) throw new FrameError("Organs cannot be read.");
  return organs;
}

/** Each travels as the difference to the one before it, modulo 256. */
function readBytes(source: NumberSource, fields: Fields, count: number): Uint8Array {
  const values = new Uint8Array(count);
  let byte = 0;
  for (let i = 0; i < count; i += 1) {
    byte = (byte + source.byte(fields[Math.min(i, 1)]!)) & 0xff;
    values[i] = byte;
  }
  return values;
}

/** Each travels as the difference to the one before it. */
function readBirths(source: NumberSource, fields: Fields, count: number): Uint32Array {
  const values = new Uint32Array(count);
  let born = 0;
  for (let i = 0; i < count; i += 1) {
    born = (born + source.number(fields[Math.min(i, 1)]!)) >>> 0;
    values[i] = born;
  }
  return values;
}

/** Each travels as the difference to the one before it. */
function readRadii(source: NumberSource, count: number): Uint16Array {
  const values = new Uint16Array(count);
  let code = 0;
  for (let i = 0; i < count; i += 1) {
    code += zigzag(source, i === 0 ? Field.FirstRadius : Field.Radius);
    if (code < 0 || code > 0xffff) throw new FrameError(`A radius code of ${code} has not 16 bits.`);
    values[i] = code;
  }
  return values;
}

/** All first numbers, then all second and all third ones on the wire; interleaved here. */
function readPositions(
  source: NumberSource,
  count: number,
  field: (i: number, part: number) => FieldNumber,
): Int32Array {
  const values = new Int32Array(3 * count);
  for (let part = 0; part < 3; part += 1) {
    for (let i = 0; i < count; i += 1) values[3 * i + part] = zigzag(source, field(i, part));
  }
  return values;
}
