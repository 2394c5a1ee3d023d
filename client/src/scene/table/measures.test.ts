import { describe, expect, it } from "vitest";
import { measuresOf } from "./measures";

/** Rows as `[parent, x, y, z, radius code, born]`. */
function table(...rows: readonly (readonly [number, number, number, number, number, number])[]) {
  return {
    rows: rows.length,
    position: rows.flatMap(([, x, y, z]) => [x, y, z]),
    parent: rows.map(([parent]) => parent),
    radiusCode: rows.map(([, , , , code]) => code),
    born: rows.map(([, , , , , born]) => born),
  };
}

describe("the measures of plants", () => {
  it("are those of the wood that lives", () => {
    const rows = table(
      [-1, 0, 0, 0, 9, 0],
      [0, 0, 5, 0, 9, 1],
      [1, 3, 8, 1, 9, 4],
      [1, -2, 6, 0, 9, 5],
      [3, -40, 90, 0, 0, 7],
    );
    expect(measuresOf(rows)).toEqual({ height: 8, spread: 5, age: 5 });
  });

  it("are those of one plant each where there are several", () => {
    const rows = table(
      [-1, 0, 0, 0, 9, 0],
      [0, 1, 5, 0, 9, 9],
      [-1, 100, 0, 0, 9, 20],
      [2, 100, 4, 0, 9, 21],
      [2, 100, 2, 6, 9, 23],
    );
    expect(measuresOf(rows), "not the distance between them").toEqual({ height: 5, spread: 6, age: 9 });
  });

  it("a seed has none", () => {
    expect(measuresOf(table([-1, 0, 0, 0, 9, 0]))).toBeNull();
  });
});
