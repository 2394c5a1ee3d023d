import { expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { LeafSlots } from "./leaf-slots";

it("no two rows ever share a slot", () => {
  const random = randoms(9);
  const slots = new LeafSlots();
  const held = new Map<number, number>();
  for (let round = 0; round < 400; round += 1) {
    if (random() < 0.01) {
      const rows = Math.floor(random() * 60);
      slots.truncate(rows, () => {});
      for (const row of [...held.keys()]) if (row >= rows) held.delete(row);
    } else {
      const row = Math.floor(random() * 60);
      const count = Math.floor(random() * 16);
      slots.assign(row, count, () => {});
      held.set(row, count);
    }
    const taken = new Set<number>();
    let sum = 0;
    for (const [row, count] of held) {
      expect(slots.countOf(row)).toBe(count);
      sum += count;
      for (let k = 0; k < count; k += 1) taken.add(slots.firstOf(row) + k);
    }
    expect(taken.size).toBe(sum);
    expect(Math.max(-1, ...taken)).toBeLessThan(slots.end);
  }
});

it("slots given back are used again", () => {
  const slots = new LeafSlots();
  const cleared: number[][] = [];
  slots.assign(0, 3, () => {});
  slots.assign(1, 3, () => {});
  slots.assign(0, 0, (first, count) => cleared.push([first, count]));
  slots.assign(2, 3, () => {});
  expect(cleared).toEqual([[0, 3]]);
  expect(slots.firstOf(2)).toBe(0);
  expect(slots.end).toBe(6);
});

it("runs moved together leave no slot unused and keep what was in them", () => {
  const random = randoms(5);
  const slots = new LeafSlots();
  const content: number[] = [];
  const fill = (row: number) => {
    for (let k = 0; k < slots.countOf(row); k += 1) content[slots.firstOf(row) + k] = 16 * row + k;
  };
  for (let row = 0; row < 300; row += 1) {
    slots.assign(row, Math.floor(random() * 16), () => {});
    fill(row);
  }
  for (let row = 0; row < 200; row += 1) {
    slots.assign(row, random() < 0.8 ? 0 : Math.floor(random() * 16), () => {});
    fill(row);
  }
  slots.compact((to, from, count) => {
    for (let k = 0; k < count; k += 1) content[to + k] = content[from + k]!;
  });
  expect(slots.end).toBe(slots.filled);
  const strangers = () =>
    Array.from({ length: 300 }, (_, row) => row).filter((row) =>
      Array.from({ length: slots.countOf(row) }, (_, k) => k).some(
        (k) => content[slots.firstOf(row) + k] !== 16 * row + k,
      ),
    );
  expect(strangers()).toEqual([]);
  for (let row = 0; row < 300; row += 1) {
    slots.assign(row, Math.floor(random() * 16), () => {});
    fill(row);
  }
  expect(strangers(), "no run is given out twice").toEqual([]);
});
