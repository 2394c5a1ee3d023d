import { expect, it } from "vitest";
import { seedsToGrow } from "./places";

const ALONE = { parent: -1, successor: -1 };

/** Seeds as the table has them. */
function table(...seeds: readonly { parent: number; successor: number; at: readonly number[] }[]) {
  return {
    rows: seeds.length,
    parent: Int32Array.from(seeds, ({ parent }) => parent),
    successor: Int32Array.from(seeds, ({ successor }) => successor),
    position: Float32Array.from(seeds.flatMap(({ at }) => at)),
  } as unknown as Parameters<typeof seedsToGrow>[0];
}

it("a seed waits to grow where no plant stands, be it one that another seed became", () => {
  const rows = table(
    { ...ALONE, at: [0, 0, 0] },
    { ...ALONE, at: [5, 0, 0] },
    { parent: -1, successor: 3, at: [0, 0, 0] },
    { parent: 2, successor: -1, at: [0, 1, 0] },
  );
  expect(seedsToGrow(rows, 60)).toEqual([[5, 0, 0]]);
});

it("of many no more are given than are wanted", () => {
  const rows = table(...[1, 2, 3].map((x) => ({ ...ALONE, at: [x, 0, 0] })));
  expect(seedsToGrow(rows, 2)).toEqual([
    [1, 0, 0],
    [2, 0, 0],
  ]);
});
