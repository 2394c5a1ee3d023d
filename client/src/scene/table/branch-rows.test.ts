import { describe, expect, it } from "vitest";
import { axisRows, branchRows } from "./branch-rows";

/** A seed, a trunk of three, a limb of two on its first node that bears a twig, and another limb on its second. */
const table = {
  rows: 9,
  parent: [-1, 0, 1, 2, 1, 4, 4, 2, 5],
  startsAxis: [0, 1, 0, 0, 1, 0, 1, 1, 0],
  radiusCode: [0, 9, 9, 9, 9, 9, 9, 9, 9],
};

describe("branch rows", () => {
  it("are the axis from where it begins, and all it bears", () => {
    expect(branchRows(table, 8, 100)).toEqual([4, 5, 6, 8]);
    expect(branchRows(table, 4, 100)).toEqual([4, 5, 6, 8]);
  });

  it("of a twig are the twig alone", () => {
    expect(branchRows(table, 6, 100)).toEqual([6]);
  });

  it("of the trunk are the whole plant without its seed", () => {
    expect(branchRows(table, 3, 100)).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
  });

  it("of what is dead are none, nor of what it bore", () => {
    const radiusCode = [0, 9, 9, 9, 9, 0, 9, 9, 9];
    expect(branchRows({ ...table, radiusCode }, 4, 100)).toEqual([4, 6]);
  });

  it("are no more than asked for", () => {
    expect(branchRows(table, 3, 3)).toEqual([1, 2, 3]);
  });
});

describe("an axis' rows", () => {
  it("go from its base to its tip, without what it bears", () => {
    expect([3, 5, 8, 6, 7].map((row) => axisRows(table, row))).toEqual([[1, 2, 3], [4, 5, 8], [4, 5, 8], [6], [7]]);
  });

  it("end where it is dead", () => {
    const radiusCode = [0, 9, 9, 9, 9, 9, 9, 9, 0];
    expect(axisRows({ ...table, radiusCode }, 4)).toEqual([4, 5]);
  });
});
