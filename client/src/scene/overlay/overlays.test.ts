import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { type Twig, tableOf } from "../../../test/small-tree";
import type { ChunkChange } from "../../wire/frame";
import { CHUNK_ROWS, POSITION_STEPS } from "../../wire/generated";
import { normalOf } from "../table/node-orientations";
import { radiusOf, type TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import { BendOverlay } from "./bend-overlay";
import { CutOverlay } from "./cut-overlay";
import { type Overlay, Overlays, type Rotation, rotated, SlotWriter } from "./overlays";
import { borne, swelling, WidthOverlay } from "./width-overlay";

const SLOT = 16;
const QUARTER: Rotation = [0, 0, Math.SQRT1_2, Math.SQRT1_2];

function tree(): TreeTable {
  const table = new PlainTable(() => 0);
  table.apply(sampleTree({ seed: 4, height: 24, orders: 2 }));
  return table;
}

/** A path of so many rows along an axis. */
function along(table: TreeTable, from: number, length: number): number[] {
  const path = [from];
  while (path.length < length) path.push(table.successor[path[path.length - 1]!]!);
  return path;
}

/** The rows that get another slot than before. */
function assigned(overlays: Overlays, table: TreeTable): Map<number, number> {
  const slots = new Map<number, number>();
  overlays.assign(table, (row, slot) => slots.set(row, slot), true);
  return slots;
}

function written(overlay: Overlay, table: TreeTable): Float32Array {
  const texels = new Float32Array(SLOT * overlay.slots);
  overlay.write(table, new SlotWriter(texels, 0));
  return texels;
}

/** Moves every row as a delta of the server would. */
function commit(table: TreeTable, placeOf: (row: number) => Vec3): void {
  const places = Array.from({ length: table.rows }, (_, row) =>
    placeOf(row).map((x) => Math.round(x * POSITION_STEPS)),
  );
  const changes: ChunkChange[] = [];
  for (let first = 0; first < table.rows; first += CHUNK_ROWS) {
    const rows = Uint8Array.from({ length: Math.min(CHUNK_ROWS, table.rows - first) }, (_, i) => i);
    const values = Int32Array.from({ length: 3 * rows.length }, (_, i) => {
      const row = first + Math.floor(i / 3);
      const parent = table.parent[row]!;
      return places[row]![i % 3]! - (parent < 0 ? 0 : places[parent]![i % 3]!);
    });
    const chunk = first / CHUNK_ROWS;
    changes.push({ change: "patch", chunk, generation: 2, rows, column: "position", values });
  }
  table.apply({ epoch: table.epoch, sequence: (table.sequence ?? 0) + 1, catchUp: false, changes });
}

function place({ position }: TreeTable, row: number): Vec3 {
  return [position[3 * row]!, position[3 * row + 1]!, position[3 * row + 2]!];
}

const distance = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Swings the upper part of a path about the end of one of its rows, with the overlay that shows it. */
function swing(table: TreeTable, path: readonly number[], about: number) {
  const pivot = place(table, path[about]!);
  const swung = (row: number): Vec3 => {
    const [x, y, z] = place(table, row);
    const [a, b, c] = rotated(QUARTER, [x - pivot[0], y - pivot[1], z - pivot[2]]);
    return [pivot[0] + a, pivot[1] + b, pivot[2] + c];
  };
  const bent = new BendOverlay(table, path);
  bent.move(path.slice(about + 1).map((row) => ({ row, rotation: QUARTER, to: swung(row) })));
  return { bent, swung };
}

describe("a bent path", () => {
  it("carries every branch with the row that bears it", () => {
    const table = tree();
    const path = along(table, 5, 6);
    const { bent, swung } = swing(table, path, 2);
    const overlays = new Overlays();
    overlays.add(bent);
    const slots = assigned(overlays, table);
    for (let row = 0; row < table.rows; row += 1) {
      let at = row;
      while (at >= 0 && !path.includes(at)) at = table.parent[at]!;
      const carrier = path.indexOf(at);
      const slot = at < 0 ? undefined : (at === row ? -1 : 1) * (1 + carrier);
      expect(slots.get(row), `row ${row}`).toBe(slot);
      const there = carrier > 2 ? swung(row) : place(table, row);
      expect(distance(overlays.placeOf(table, row), there), `row ${row}`).toBeLessThan(1e-4);
    }
  });

  it("is drawn with the orientations that the committed places will have", () => {
    const [table, after] = [tree(), tree()];
    const path = along(table, 5, 6);
    const { bent, swung } = swing(table, path, 2);
    const carried = (row: number) => {
      for (let at = row; at >= 0; at = table.parent[at]!) if (path.indexOf(at) > 2) return true;
      return false;
    };
    const texels = written(bent, table);
    commit(after, (row) => (carried(row) ? swung(row) : place(table, row)));
    for (const [i, row] of path.entries()) {
      for (const k of [0, 1, 2]) expect(texels[SLOT * i + 8 + k]).toBeCloseTo(after.orientations[4 * row + k]!, 2);
    }
    // The bark of what is carried turns no further when the places come.
    for (let row = 0; row < table.rows; row += 1) {
      if (!carried(row) || path.includes(row)) continue;
      const normal = rotated(QUARTER, normalOf(table.orientations, row));
      expect(distance(normal, normalOf(after.orientations, row)), `row ${row}`).toBeLessThan(0.25);
    }
  });

  it("at rest is drawn where thick wood runs, beside its nodes, and turns with them", () => {
    const corner = (i: number): Twig => ({ parent: i, at: [(i % 3) * 0.7, i + 1, 0], radius: 1.2 });
    const table = tableOf([{ parent: -1, at: [0, 0, 0] }, ...Array.from({ length: 12 }, (_, i) => corner(i))]);
    const path = [4, 5, 6, 7, 8, 9];
    const bent = new BendOverlay(table, path);
    bent.move([]);
    const texels = written(bent, table);
    for (const [i, row] of path.entries()) {
      for (const k of [0, 1, 2]) expect(texels[SLOT * i + 8 + k]).toBeCloseTo(table.orientations[4 * row + k]!, 4);
    }
    const seen = (row: number): Vec3 => [...table.course.placed.slice(3 * row, 3 * row + 3)] as unknown as Vec3;
    const far = (row: number) => distance(seen(row), place(table, row));
    expect(far(6)).toBeGreaterThan(0.05);
    const swung = swing(table, path, 2);
    const overlays = new Overlays();
    overlays.add(swung.bent);
    assigned(overlays, table);
    // As far from its node as it was, wherever that is taken.
    for (const row of [7, 8, 9]) {
      expect(distance(overlays.placeOf(table, row), swung.swung(row))).toBeCloseTo(far(row), 4);
    }
  });

  it("is over in the frame in which the places come", () => {
    const table = tree();
    const path = along(table, 5, 6);
    const { bent, swung } = swing(table, path, 2);
    const overlays = new Overlays();
    overlays.add(bent);
    assigned(overlays, table);
    overlays.settle(table);
    expect(overlays.has(bent)).toBe(true);
    commit(table, (row) => (path.indexOf(row) > 2 ? swung(row) : place(table, row)));
    overlays.settle(table);
    expect(overlays.has(bent)).toBe(false);
    const slots = assigned(overlays, table);
    expect(slots.size).toBeGreaterThan(path.length);
    expect(new Set(slots.values())).toEqual(new Set([0]));
  });

  it("carries what grows on it meanwhile", () => {
    const table = tree();
    const path = along(table, 5, 3);
    const overlays = new Overlays();
    overlays.add(new BendOverlay(table, path));
    assigned(overlays, table);
    const row = table.rows;
    const start = row % CHUNK_ROWS;
    const rows = {
      parent: Uint32Array.of(2 * (row - path[1]!) + 1),
      position: Int32Array.of(200, 0, 0),
      radius: Uint16Array.of(400),
      foliage: Uint8Array.of(3),
      light: Uint8Array.of(9),
      born: Uint32Array.of(1),
    };
    const changes: ChunkChange[] = [
      { change: "append", chunk: (row - start) / CHUNK_ROWS, generation: 2, start, rows },
    ];
    table.apply({ epoch: 1, sequence: 2, catchUp: false, changes });
    expect([...assigned(overlays, table)]).toEqual([[row, 2]]);
  });
});

describe("overlays", () => {
  it("of two that meet the later one shows, until it is taken off", () => {
    const table = tree();
    const path = along(table, 5, 4);
    const [bent, felled] = [new BendOverlay(table, path), new CutOverlay([path[2]!], "hidden")];
    const overlays = new Overlays();
    overlays.add(bent);
    assigned(overlays, table);
    overlays.add(felled);
    const cut = assigned(overlays, table);
    expect([cut.get(path[2]!), cut.get(path[3]!), cut.get(path[1]!)]).toEqual([5, 5, undefined]);
    expect([overlays.hides(path[3]!), overlays.hides(path[1]!)]).toEqual([true, false]);
    overlays.remove(felled);
    expect(assigned(overlays, table).get(path[3]!)).toBe(-4);
    overlays.remove(bent);
    assigned(overlays, table);
    expect([overlays.active, overlays.placeOf(table, path[3]!)]).toEqual([false, place(table, path[3]!)]);
  });

  it("a cut branch stays hidden until its rows are dead", () => {
    const table = tree();
    const felled = new CutOverlay([table.successor[5]!], "hidden");
    expect(felled.over(table)).toBe(false);
    const row = felled.rows[0]!;
    const values = Int32Array.of(0);
    const change = { change: "patch", chunk: 0, generation: 2, rows: Uint8Array.of(row), column: "radius" } as const;
    table.apply({ epoch: 1, sequence: 2, catchUp: false, changes: [{ ...change, values }] });
    expect(felled.over(table)).toBe(true);
  });

  it("there is no room for more slots than the texture has", () => {
    const overlays = new Overlays();
    const table = tree();
    expect(overlays.add(new CutOverlay([3], "marked"))).toBe(true);
    const endless = { ...new CutOverlay([3], "marked"), slots: 4096 } as unknown as Overlay;
    expect(overlays.add(endless)).toBe(false);
    expect(assigned(overlays, table).get(3)).toBe(1);
  });
});

describe("a swollen limb", () => {
  const girth = { exponent: 2.5, twigDiameter: 0.07 };

  it("keeps its twigs and takes the wood below along", () => {
    const table = tree();
    const row = along(table, 1, 8)[7]!;
    const before = radiusOf(table.radiusCode[row]!);
    const swollen = new WidthOverlay(table, row, new Set(), girth, 4 * before);
    const texels = written(swollen, table);
    const [exponent, factor] = [texels[12]!, texels[13]!];
    expect(factor * 0.035 ** exponent, "a twig stays a twig").toBeCloseTo(0.035, 5);
    expect(factor * before ** exponent, "what goes on from the limb is as thick").toBeCloseTo(2 * before, 4);
    expect(texels[SLOT + 11], "the limb itself").toBeCloseTo(2 * before, 5);
    const overlays = new Overlays();
    overlays.add(swollen);
    const slots = assigned(overlays, table);
    const foot = along(table, 1, 8)[0]!;
    expect(slots.get(foot)).toBeLessThan(0);
    const lateral = table.parent.findIndex((parent, at) => parent === foot && table.successor[foot] !== at);
    expect(lateral === -1 || slots.get(lateral) === undefined, "laterals below stay").toBe(true);
  });

  it("ends at other widths that are set", () => {
    const table = tree();
    const path = along(table, 1, 12);
    const others = new Set([path[3]!, path[9]!]);
    const swollen = new WidthOverlay(table, path[6]!, others, girth, 2);
    const overlays = new Overlays();
    overlays.add(swollen);
    const slots = assigned(overlays, table);
    expect([3, 4, 5, 6].map((i) => slots.get(path[i]!) ?? 0)).toEqual([0, -5, -4, -2]);
    expect([7, 8].map((i) => slots.get(path[i]!))).toEqual([1, 1]);
    expect([9, 10].map((i) => slots.get(path[i]!))).toEqual([3, 3]);
  });

  it("below it r^n grows by as much as the limb's own", () => {
    const r = borne(1, 0.5, 0.8, 2.5);
    expect(r ** 2.5).toBeCloseTo(1 + 0.8 ** 2.5 - 0.5 ** 2.5, 10);
    expect(borne(1, 0.999, 0.01, 2.5), "never to nothing").toBeGreaterThan(0.04);
    expect(swelling(1, 5), "a tip tells nothing of the branch").toBe(1);
    expect(swelling(4, 16)).toBeCloseTo(2, 10);
  });
});
