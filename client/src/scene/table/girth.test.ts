import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { randoms } from "../../../test/randoms";
import { sampleTree } from "../../../test/sample-tree";
import { type Twig, tableOf } from "../../../test/small-tree";
import type { ChunkChange } from "../../wire/frame";
import { excess, NO_SLOPE, STEEPEST, slopeCode } from "./girth";
import { Dirty, radiusOf } from "./tree-table";

/** A trunk of ten that has lost girth after its fourth metamer. */
const dropping = (thick: number, thin: number): readonly Twig[] => [
  { parent: -1, at: [0, 0, 0] },
  ...Array.from({ length: 10 }, (_, i) => ({
    parent: i,
    at: [0, i + 1, 0] as const,
    radius: i < 4 ? thick : thin,
  })),
];

describe("girth", () => {
  it("is lost over a radius or two, not at once", () => {
    const { radius } = tableOf(dropping(2, 1)).girth;
    expect(radius[4]).toBeCloseTo(2, 1);
    for (let row = 5; row <= 10; row += 1) {
      expect(radius[row]!).toBeLessThanOrEqual(radius[row - 1]!);
      expect(radius[row - 1]! - radius[row]!).toBeLessThanOrEqual(STEEPEST + 1e-3);
      expect(radius[row]!).toBeGreaterThan(0.99);
    }
    expect(radius[10]).toBeLessThan(1.2);
  });

  it("of twigs is what the server has", () => {
    const table = tableOf(dropping(0.1, 0.05));
    for (let row = 1; row <= 10; row += 1) {
      expect(table.girth.radius[row]).toBeCloseTo(radiusOf(table.radiusCode[row]!), 6);
    }
  });

  it("has slopes that go on from one metamer to the next", () => {
    const { radius, slope } = tableOf(dropping(2, 1)).girth;
    expect(slope[2]).toBe(0);
    for (let row = 5; row <= 8; row += 1) {
      const steepness = -slope[row]! * radius[row]!;
      expect(steepness).toBeGreaterThan(0);
      expect(steepness).toBeLessThanOrEqual(
        2 * Math.min(radius[row - 1]! - radius[row]!, radius[row]! - radius[row + 1]!) + 1e-4,
      );
    }
    expect(slopeCode(0)).toBe(NO_SLOPE);
    expect([slopeCode(-9), slopeCode(9)]).toEqual([1, 255]);
  });

  it("runs out the same in one go as in many", () => {
    const [one, other] = [excess(1.5, 3, 2), excess(excess(1.5, 1, 2), 2, 2)];
    expect(one).toBeCloseTo(other, 9);
    expect(excess(-1, 1, 2)).toBe(0);
    expect(excess(1, 100, 2)).toBeLessThan(1e-9);
  });

  it("tells only of rows that are drawn otherwise", () => {
    const table = tableOf(dropping(2, 2));
    table.drain(
      () => undefined,
      () => undefined,
    );
    const code = tableOf(dropping(1.4, 1)).radiusCode;
    const rows = Uint8Array.of(4);
    const values = Int32Array.of(code[4]!);
    table.apply({
      epoch: 1,
      sequence: 2,
      catchUp: true,
      changes: [{ change: "patch", chunk: 0, generation: 2, column: "radius", rows, values }],
    });
    const drawn: number[] = [];
    table.drain(
      () => undefined,
      (row, bits) => {
        expect(bits).toBe(Dirty.Drawn);
        drawn.push(row);
      },
    );
    expect(drawn).toContain(4);
    expect(Math.min(...drawn)).toBeGreaterThanOrEqual(3);
    expect(Math.max(...drawn)).toBeLessThanOrEqual(6);
  });

  it("after any changes is as if made afresh", () => {
    const random = randoms(12);
    const sample = sampleTree({ seed: 2, height: 24, orders: 3 });
    const table = new PlainTable(() => 0);
    table.apply(sample);
    for (let sequence = sample.sequence + 1; sequence < 40; sequence += 1) {
      const rows = Uint8Array.from({ length: 30 }, (_, i) => 2 + 8 * i + Math.floor(7 * random()));
      const values = Int32Array.from(rows, () => (random() < 0.2 ? 0 : 400 + Math.floor(random() * 300)));
      const patch = { change: "patch", chunk: sequence % 2, generation: 1, column: "radius", rows, values } as const;
      table.apply({ epoch: 1, sequence, catchUp: false, changes: [patch] });
    }
    const fresh = new PlainTable(() => 0);
    const changes = sample.changes.map((change, chunk): ChunkChange => {
      if (change.change !== "replace") throw new Error("a sample is whole");
      const radius = table.radiusCode.slice(256 * chunk, 256 * chunk + change.rows.radius.length);
      return { ...change, rows: { ...change.rows, radius } };
    });
    fresh.apply({ ...sample, changes });
    for (let row = 0; row < table.rows; row += 1) {
      if (table.radiusCode[row] === 0 && row > 0) continue;
      expect(table.limbs.onward[row], `onward of ${row}`).toBe(fresh.limbs.onward[row]);
      expect(table.girth.radius[row], `girth of ${row}`).toBe(fresh.girth.radius[row]);
      expect(table.girth.slope[row], `slope of ${row}`).toBe(fresh.girth.slope[row]);
    }
  });
});
