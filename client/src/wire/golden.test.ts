import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { ChunkChange, Rows } from "./frame";
import { FrameKind } from "./generated";
import { readPresence } from "./presence-frame";
import { decodeServerFrame, type ServerFrame } from "./server-frame";

const folder = new URL("../../../proto/golden/", import.meta.url);
const names = readdirSync(folder)
  .filter((file) => file.endsWith(".bin"))
  .map((file) => file.slice(0, -".bin".length));

/** The frame in the words of the samples' descriptions. */
function described({ kind, frame }: ServerFrame): object {
  if (kind === FrameKind.Bend) return frame;
  if (kind === FrameKind.Presence) {
    return { epoch: frame.epoch, sequence: frame.sequence, devices: readPresence(frame.body) };
  }
  const { epoch, sequence } = frame;
  const changes = frame.changes.map(describedChange);
  return kind === FrameKind.Ghost
    ? { epoch, sequence, changes }
    : { epoch, sequence, catch_up: frame.catchUp, changes };
}

function describedChange(change: ChunkChange): object {
  if (change.change === "truncate") return change;
  if (change.change === "patch") {
    return {
      ...change,
      rows: [...change.rows],
      values: describedValues(change),
    };
  }
  return { ...change, rows: describedRows(change.rows) };
}

function describedValues(change: Extract<ChunkChange, { change: "patch" }>): unknown[] {
  if (change.column === "organs") return change.values.map((organs) => organs && [...organs]);
  return change.column === "position" ? triples(change.values) : [...change.values];
}

function describedRows(rows: Rows): object {
  return {
    parent: [...rows.parent],
    position: triples(rows.position),
    radius: [...rows.radius],
    foliage: [...rows.foliage],
    light: [...rows.light],
    born: [...rows.born],
  };
}

function triples(values: ArrayLike<number>): number[][] {
  return Array.from({ length: values.length / 3 }, (_, i) => [values[3 * i]!, values[3 * i + 1]!, values[3 * i + 2]!]);
}

describe("the golden samples", () => {
  it("are of every kind", () => {
    const kinds = (name: string) => readFileSync(new URL(`${name}.bin`, folder))[1];
    expect(new Set(names.map(kinds))).toEqual(new Set(Object.values(FrameKind)));
  });

  it.each(names)("%s decodes to what is described", async (name) => {
    const bytes = new Uint8Array(readFileSync(new URL(`${name}.bin`, folder))).buffer;
    const description: unknown = JSON.parse(readFileSync(new URL(`${name}.json`, folder), "utf8"));
    expect(described(await decodeServerFrame(bytes))).toEqual(description);
  });

  it.each(names)("%s is an error wherever it is cut short", async (name) => {
    const bytes = new Uint8Array(readFileSync(new URL(`${name}.bin`, folder)));
    for (let length = 0; length < bytes.length; length += 1 + (length >> 5)) {
      await expect(decodeServerFrame(bytes.slice(0, length).buffer)).rejects.toThrow();
    }
  });
});
