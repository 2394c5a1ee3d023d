import { beforeEach, describe, expect, it, vi } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import type { Uniforms } from "../materials";
import { Crown, type CrownWorker } from "./crown";
import { crownField } from "./crown-field";
import { crownOf } from "./crown-of";

const tree = () => {
  const table = new PlainTable(() => 0);
  table.apply(sampleTree({ seed: 5, height: 60, orders: 3 }));
  return table;
};

it("has as much in its cells as the tree has leaves and wood", () => {
  const table = tree();
  let leaves = 0;
  for (let row = 0; row < table.rows; row += 1) {
    if (table.radiusCode[row] !== 0 && table.parent[row]! >= 0) leaves += table.foliage[row]! & 15;
  }
  const sum = (leaf: number) => crownOf(table, leaf).order.area.reduce((total, each) => total + each, 0);
  expect(sum(1) - sum(0)).toBeGreaterThan(0.999 * 0.55 * leaves);
  expect(sum(1) - sum(0)).toBeLessThan(1.001 * 0.55 * leaves);
});

describe("a crown", () => {
  let worker: CrownWorker & { sent: number };
  let crown: Crown;
  let told: number;

  beforeEach(() => {
    vi.useFakeTimers();
    told = 0;
    worker = {
      sent: 0,
      onmessage: null,
      onerror: null,
      postMessage: () => {
        worker.sent += 1;
      },
      terminate: () => {},
    };
    const uniforms: Uniforms = { uLeafSize: { value: 0.7 } };
    crown = new Crown(
      tree(),
      uniforms,
      () => {
        told += 1;
      },
      () => worker,
    );
  });

  it("is looked at once nothing has changed for a while, and shown when it is asked for", () => {
    crown.changed();
    vi.advanceTimersByTime(100);
    crown.changed();
    vi.advanceTimersByTime(100);
    expect(worker.sent).toBe(0);
    vi.advanceTimersByTime(100);
    expect(worker.sent).toBe(1);
    expect([crown.ripe, crown.unfinished, told]).toEqual([false, true, 0]);
    worker.onmessage!({ data: new Uint8Array(4 * 32 ** 3) });
    expect([crown.ripe, crown.unfinished, told]).toEqual([true, true, 1]);
    crown.ripen();
    expect([crown.ripe, crown.unfinished]).toEqual([false, false]);
  });

  it("is looked at again where the tree has changed meanwhile", () => {
    crown.changed();
    vi.advanceTimersByTime(200);
    crown.changed();
    vi.advanceTimersByTime(200);
    expect(worker.sent).toBe(1);
    worker.onmessage!({ data: new Uint8Array(4 * 32 ** 3) });
    vi.advanceTimersByTime(200);
    expect(worker.sent).toBe(2);
  });

  it("is made on the page where no worker is to be had", () => {
    crown.changed();
    vi.advanceTimersByTime(200);
    worker.onerror!();
    expect([crown.ripe, told]).toEqual([true, 1]);
    crown.ripen();
    crown.changed();
    vi.advanceTimersByTime(200);
    expect([crown.ripe, told, worker.sent]).toEqual([true, 2, 1]);
  });
});

it("has leaves in a tree's crown look out of it and up", () => {
  const table = tree();
  const { order, from, size } = crownOf(table, 0.7);
  const field = crownField(order);
  const { min, max } = table.bounds();
  const middle = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  let [outward, all] = [0, 0];
  for (let row = 0; row < table.rows; row += 7) {
    if ((table.foliage[row]! & 15) === 0) continue;
    const place = [0, 1, 2].map((axis) => table.position[3 * row + axis]!);
    const cell = place.map((value, axis) => Math.floor(((value - from[axis]!) / size[axis]!) * 32));
    const at = 4 * ((cell[2]! * 32 + cell[1]!) * 32 + cell[0]!);
    const out = [0, 2].reduce((sum, axis) => sum + (field[at + axis]! - 127.5) * (place[axis]! - middle[axis]!), 0);
    outward += out > 0 ? 1 : 0;
    all += 1;
  }
  expect(outward / all).toBeGreaterThan(0.7);
});
