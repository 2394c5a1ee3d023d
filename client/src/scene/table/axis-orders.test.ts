import { describe, expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { AxisOrders } from "./axis-orders";

/** A tree that may be changed. */
class Axes {
  rows = 0;
  parent = new Int32Array(64);
  startsAxis = new Uint8Array(64);

  add(parent: number, startsAxis: boolean): void {
    if (this.rows === this.parent.length) {
      this.parent = Int32Array.from({ length: 2 * this.rows }, (_, row) => this.parent[row] ?? 0);
      this.startsAxis = Uint8Array.from({ length: 2 * this.rows }, (_, row) => this.startsAxis[row] ?? 0);
    }
    this.parent[this.rows] = parent;
    this.startsAxis[this.rows] = startsAxis ? 1 : 0;
    this.rows += 1;
  }

  /** By the definition: how many lateral axes lie between a row and its seed. */
  order(row: number): number {
    const above = this.parent[row]!;
    if (above < 0) return 0;
    return this.order(above) + (this.startsAxis[row] === 1 && this.parent[above]! >= 0 ? 1 : 0);
  }
}

describe("axis orders", () => {
  it("the trunk is 0 and its laterals 1, whatever the seed's flag", () => {
    const axes = new Axes();
    for (const [parent, starts] of [
      [-1, false],
      [0, true],
      [1, false],
      [1, true],
      [3, true],
    ] as const) {
      axes.add(parent, starts);
    }
    const orders = new AxisOrders();
    orders.update(axes);
    expect([...orders.values.subarray(0, 5)]).toEqual([0, 0, 0, 1, 2]);
  });

  it("follow whatever is added, moved and cut off", () => {
    const random = randoms(7);
    const axes = new Axes();
    const orders = new AxisOrders();
    axes.add(-1, false);
    for (let turn = 0; turn < 120; turn += 1) {
      const what = random();
      if (what < 0.7 || axes.rows < 4) {
        for (let i = 0; i < 10; i += 1) axes.add(Math.floor(random() * axes.rows), random() < 0.4);
      } else if (what < 0.85) {
        const row = 1 + Math.floor(random() * (axes.rows - 1));
        axes.parent[row] = Math.floor(random() * row);
        orders.forget(row);
      } else {
        axes.rows = 1 + Math.floor(random() * (axes.rows - 1));
        orders.forget(axes.rows);
      }
      orders.update(axes);
      for (let row = 0; row < axes.rows; row += 1) expect(orders.values[row]).toBe(axes.order(row));
    }
  });
});
