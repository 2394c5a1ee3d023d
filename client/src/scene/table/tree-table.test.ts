import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { randoms } from "../../../test/randoms";
import { sampleTree } from "../../../test/sample-tree";
import { type ChunkChange, type Frame, FrameError, type Rows } from "../../wire/frame";
import { CHUNK_ROWS } from "../../wire/generated";
import { normalOf, tangentOf } from "./node-orientations";
import { Dirty, radiusOf, type TreeTable } from "./tree-table";

/** Rows from [parent code, dx, dy, dz, radius code] each. */
function rows(...of: [number, number, number, number, number][]): Rows {
  return {
    parent: Uint32Array.from(of, (r) => r[0]),
    position: Int32Array.from(of.flatMap((r) => [r[1], r[2], r[3]])),
    radius: Uint16Array.from(of, (r) => r[4]),
    foliage: Uint8Array.from(of, () => 3),
    light: Uint8Array.from(of, () => 200),
    born: Uint32Array.from(of, (_, row) => row),
  };
}

function frame(sequence: number, changes: ChunkChange[], catchUp = false): Frame {
  return { epoch: 5, sequence, catchUp, changes };
}

const SAPLING = rows([0, 0, 0, 0, 0], [2, 0, 256, 0, 400], [2, 0, 256, 0, 400], [2, 128, 256, 0, 400]);

function sapling(): TreeTable {
  const table = new PlainTable(() => 10);
  table.apply(frame(1, [{ change: "append", chunk: 0, generation: 1, start: 0, rows: SAPLING }]));
  return table;
}

function drained(table: TreeTable) {
  const changed = new Map<number, number>();
  let survived = -1;
  table.drain(
    (rows) => {
      survived = rows;
    },
    (row, bits) => changed.set(row, bits),
  );
  return { survived, changed };
}

describe("the table", () => {
  it("resolves positions through the parent", () => {
    const table = sapling();
    expect([...table.position.slice(9, 12)]).toEqual([0.5, 3, 0]);
    expect([...table.parent.slice(0, 4)]).toEqual([-1, 0, 1, 2]);
    expect(table.generations()).toEqual([1]);
    expect(table.epoch).toBe(5);
  });

  it("turns radius codes into internodes", () => {
    expect(radiusOf(0)).toBe(0);
    expect(radiusOf(1)).toBeCloseTo(0.001, 9);
    expect(radiusOf(392)).toBeCloseTo(0.001 * Math.exp(3.91), 9);
  });

  it("FR4: takes the next frame only, but any that catches up", () => {
    const table = sapling();
    expect(() => table.apply(frame(3, []))).toThrow(FrameError);
    table.apply(frame(9, [], true));
    table.apply(frame(10, []));
    expect(table.sequence).toBe(10);
  });

  it("FR5: refuses a parent that is not below its child", () => {
    const change = (code: number): ChunkChange => ({
      change: "append",
      chunk: 0,
      generation: 2,
      start: 4,
      rows: rows([code, 0, 0, 0, 9]),
    });
    expect(() => sapling().apply(frame(2, [change(1)]))).toThrow(/FR5/);
    expect(() => sapling().apply(frame(2, [change(10)]))).toThrow(/FR5/);
    expect(() => sapling().apply(frame(2, [change(8)]))).not.toThrow();
  });

  it("FR6: a moved metamer leaves its descendants where they are", () => {
    const table = sapling();
    table.apply(
      frame(2, [
        {
          change: "patch",
          chunk: 0,
          generation: 2,
          rows: Uint8Array.of(2),
          column: "position",
          values: Int32Array.of(256, 0, 0),
        },
      ]),
    );
    expect([...table.position.slice(6, 12)]).toEqual([1, 1, 0, 0.5, 3, 0]);
    expect(table.generations()).toEqual([2]);
  });

  it("refuses changes that do not fit its rows", () => {
    const gap: ChunkChange = { change: "append", chunk: 0, generation: 2, start: 5, rows: rows([2, 0, 1, 0, 1]) };
    const beyond: ChunkChange = { change: "replace", chunk: 1, generation: 2, rows: rows([2, 0, 1, 0, 1]) };
    const patch: ChunkChange = {
      change: "patch",
      chunk: 0,
      generation: 2,
      rows: Uint8Array.of(4),
      column: "light",
      values: Int32Array.of(1),
    };
    for (const change of [gap, beyond, patch, { change: "truncate", rows: 5 } as const]) {
      expect(() => sapling().apply(frame(2, [change]))).toThrow(FrameError);
    }
    expect(() => sapling().apply({ ...frame(2, []), epoch: 6 })).toThrow(/epoch/);
  });

  it("forgets chunks that lose all their rows", () => {
    const table = new PlainTable();
    table.apply(sampleTree({ seed: 2, height: 30, orders: 3 }));
    expect(table.rows).toBeGreaterThan(2 * CHUNK_ROWS);
    table.apply({ epoch: 1, sequence: 2, catchUp: false, changes: [{ change: "truncate", rows: CHUNK_ROWS }] });
    expect(table.generations()).toHaveLength(1);
    table.clear();
    expect([table.rows, table.epoch, table.generations()]).toEqual([0, 0, []]);
  });

  it("knows what continues each axis, and what is dead", () => {
    const table = sapling();
    const lateral = rows([5, 256, 0, 0, 300], [2, 256, 0, 0, 300]);
    table.apply(frame(2, [{ change: "append", chunk: 0, generation: 2, start: 4, rows: lateral }]));
    expect([...table.successor.slice(0, 6)]).toEqual([1, 2, 3, -1, 5, -1]);
    expect(table.limbOrigin[5]).toBe(2);
    expect(table.arc[5]).toBeCloseTo(2);
    const dead: ChunkChange = {
      change: "patch",
      chunk: 0,
      generation: 3,
      rows: Uint8Array.of(3),
      column: "radius",
      values: Int32Array.of(0),
    };
    table.apply(frame(3, [dead]));
    expect(table.successor[2]).toBe(-1);
  });

  it("a table patched is the table sent whole", () => {
    const random = randoms(77);
    const table = new PlainTable(() => 0);
    const sample = sampleTree({ seed: 8, height: 16, orders: 3 });
    table.apply(sample);
    const seen = drained(table);
    expect(seen.changed.size).toBe(table.rows);
    for (let sequence = 2; sequence < 40; sequence += 1) {
      const chunk = Math.floor((random() * table.rows) / CHUNK_ROWS);
      const within = Math.min(CHUNK_ROWS, table.rows - chunk * CHUNK_ROWS);
      const picked = Uint8Array.from(
        [...new Set(Array.from({ length: 9 }, () => Math.floor(random() * within)))].sort((a, b) => a - b),
      );
      const head = { change: "patch", chunk, generation: sequence, rows: picked } as const;
      const change: ChunkChange =
        random() < 0.5
          ? {
              ...head,
              column: "position",
              values: Int32Array.from({ length: 3 * picked.length }, () => Math.floor(random() * 300 - 90)),
            }
          : { ...head, column: "radius", values: Int32Array.from(picked, () => (random() < 0.05 ? 0 : 400)) };
      table.apply({ epoch: 1, sequence, catchUp: false, changes: [change] });
    }
    const whole = new PlainTable(() => 0);
    whole.apply({ epoch: 1, sequence: 40, catchUp: true, changes: wholly(table) });
    const n = table.rows;
    expect(whole.quantised.slice(0, 3 * n)).toEqual(table.quantised.slice(0, 3 * n));
    expect(whole.successor.slice(0, n)).toEqual(table.successor.slice(0, n));
    let compared = 0;
    const living = new Uint8Array(n);
    for (let row = 0; row < n; row += 1) {
      const parent = table.parent[row]!;
      // Nothing is drawn of the dead nor of what hangs on them, and their orientations are not kept up.
      living[row] = parent < 0 || (living[parent] === 1 && table.radiusCode[row] !== 0) ? 1 : 0;
      if (living[row] === 0) continue;
      compared += 1;
      expect(whole.arc[row]).toBeCloseTo(table.arc[row]!, 1);
      for (const column of [tangentOf, normalOf]) {
        const [a, b] = [column(whole.orientations, row), column(table.orientations, row)];
        expect(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), `orientation of row ${row}`).toBeLessThan(0.03);
      }
    }
    expect(compared).toBeGreaterThan(20);
  });
});

/** The table as one replacement of each chunk. */
function wholly(table: TreeTable): ChunkChange[] {
  const changes: ChunkChange[] = [];
  for (let first = 0; first < table.rows; first += CHUNK_ROWS) {
    const all = Array.from({ length: Math.min(CHUNK_ROWS, table.rows - first) }, (_, i) => first + i);
    changes.push({
      change: "replace",
      chunk: first / CHUNK_ROWS,
      generation: 1,
      rows: {
        parent: Uint32Array.from(all, (row) => {
          const parent = table.parent[row]!;
          return parent < 0 ? 0 : 2 * (row - parent) + table.startsAxis[row]!;
        }),
        position: Int32Array.from(
          all.flatMap((row) =>
            [0, 1, 2].map((axis) => {
              const parent = table.parent[row]!;
              return table.quantised[3 * row + axis]! - (parent < 0 ? 0 : table.quantised[3 * parent + axis]!);
            }),
          ),
        ),
        radius: Uint16Array.from(all, (row) => table.radiusCode[row]!),
        foliage: Uint8Array.from(all, (row) => table.foliage[row]!),
        light: Uint8Array.from(all, (row) => table.light[row]!),
        born: Uint32Array.from(all, (row) => table.born[row]!),
      },
    });
  }
  return changes;
}

describe("numbers of trees", () => {
  const numberOf = (begins: number) => {
    const table = new PlainTable(() => 10);
    const trunk = rows([0, 0, 0, 0, 0], [2, 1, 256, 0, 400], [2, begins, 256, 0, 400], [2, 0, 256, 0, 400]);
    table.apply(frame(1, [{ change: "append", chunk: 0, generation: 1, start: 0, rows: trunk }]));
    return table.numberOf(0);
  };

  it("differ from tree to tree, and are the same for the same one", () => {
    const numbers = Array.from({ length: 20 }, (_, begins) => numberOf(begins));
    expect(new Set(numbers).size).toBe(20);
    expect(Array.from({ length: 20 }, (_, begins) => numberOf(begins))).toEqual(numbers);
    for (const number of numbers) expect(Math.fround(number)).toBe(number);
  });

  it("stay as the trunk grows on, bears limbs and is bent", () => {
    const table = sapling();
    const number = table.numberOf(0);
    const more = rows([2, 40, 256, 0, 300], [7, 256, 0, 0, 300], [2, 256, 0, 0, 300]);
    table.apply(frame(2, [{ change: "append", chunk: 0, generation: 2, start: 4, rows: more }]));
    const bent = { change: "patch", chunk: 0, generation: 3, column: "position" } as const;
    table.apply(frame(3, [{ ...bent, rows: Uint8Array.of(1, 2), values: Int32Array.of(20, 255, 0, 40, 252, 0) }]));
    expect(table.numberOf(0)).toBe(number);
  });

  it("are others when a trunk begins otherwise, and then the seed is drawn again", () => {
    const table = sapling();
    const number = table.numberOf(0);
    drained(table);
    table.apply(frame(2, [{ change: "truncate", rows: 2 }]));
    const other = rows([2, 30, 256, 0, 400], [2, 0, 256, 0, 400]);
    table.apply(frame(3, [{ change: "append", chunk: 0, generation: 3, start: 2, rows: other }]));
    expect(drained(table).changed.get(0)).toBe(Dirty.Drawn);
    expect(table.numberOf(0)).not.toBe(number);
  });
});

describe("what is to be drawn again", () => {
  it("is only what changed", () => {
    const table = sapling();
    expect(drained(table).changed.size).toBe(4);
    expect(drained(table).changed.size).toBe(0);
    table.apply(
      frame(2, [
        { change: "patch", chunk: 0, generation: 2, rows: Uint8Array.of(1), column: "light", values: Int32Array.of(9) },
      ]),
    );
    expect([...drained(table).changed]).toEqual([[1, Dirty.Drawn]]);
  });

  it("reaches a moved metamer's children: their tubes begin elsewhere", () => {
    const table = sapling();
    drained(table);
    table.apply(
      frame(2, [
        {
          change: "patch",
          chunk: 0,
          generation: 2,
          rows: Uint8Array.of(1),
          column: "position",
          values: Int32Array.of(9, 200, 9),
        },
      ]),
    );
    expect(drained(table).changed.get(2)! & Dirty.Shape).toBe(Dirty.Shape);
  });

  it("says how many rows survived a truncation", () => {
    const table = sapling();
    drained(table);
    const again: ChunkChange = { change: "append", chunk: 0, generation: 2, start: 2, rows: rows([2, 0, 256, 0, 9]) };
    table.apply(frame(2, [{ change: "truncate", rows: 2 }, again]));
    const { survived, changed } = drained(table);
    expect(survived).toBe(2);
    expect(changed.get(2)! & Dirty.Shape).toBe(Dirty.Shape);
  });
});

describe("new growth", () => {
  it("eases in one after the other, all within a quarter second", () => {
    const table = sapling();
    const end = (row: number) => table.birth[row]! + table.growing[row]!;
    for (const row of [2, 3]) expect(table.birth[row]).toBeCloseTo(end(row - 1), 5);
    expect(end(3)).toBeCloseTo(table.now() + 0.25, 5);
    expect(table.settledAt).toBeCloseTo(table.now() + 0.25, 5);
  });

  it("that was missed is there at once", () => {
    const table = new PlainTable(() => 3);
    table.apply(sampleTree({ seed: 1, height: 9, orders: 2 }));
    for (let row = 0; row < table.rows; row += 1) expect(table.birth[row]).toBeLessThan(table.now() - 100);
    expect(table.settledAt).toBeLessThan(table.now());
  });
});

describe("orientations along an axis", () => {
  it("point along the mean of both metamers and do not twist", () => {
    const table = new PlainTable();
    table.apply(sampleTree({ seed: 12, height: 24, orders: 3 }));
    for (let row = 1; row < table.rows; row += 1) {
      const next = table.successor[row]!;
      if (next < 0) continue;
      const [tangent, normal] = [tangentOf(table.orientations, row), normalOf(table.orientations, row)];
      const [tangent2, normal2] = [tangentOf(table.orientations, next), normalOf(table.orientations, next)];
      const dot = (a: number[], b: number[]) => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
      expect(dot(tangent, normal)).toBeCloseTo(0, 4);
      // What turns the tangent turns the normal by no more: the rest would be twist.
      const bend = Math.acos(Math.min(1, dot(tangent, tangent2)));
      const turn = Math.acos(Math.min(1, dot(normal, normal2)));
      expect(turn).toBeLessThan(bend + 0.02 + 0.5 * bend * bend);
    }
  });
});
