import { describe, expect, it } from "vitest";
import { SMALL, tableOf } from "../../../test/small-tree";
import { NodeTexture } from "./node-texture";
import { DYES, type Dyed, RowDyes, UNDYED } from "./row-dyes";
import type { TreeTable } from "./tree-table";

const RED = { bark: [2, 1, 1], leaves: [3, 1, 1] } as const;
const GREY = { bark: [0.5, 0.5, 0.5], leaves: [1, 1, 1] } as const;
const colours = ({ bark, leaves }: { bark: readonly number[]; leaves: readonly number[] }) => ({
  bark: [bark[0]!, bark[1]!, bark[2]!] as [number, number, number],
  leaves: [leaves[0]!, leaves[1]!, leaves[2]!] as [number, number, number],
});
/** The limb is grey, the twig on it red, and all that grew later is in no block. */
const LIMBS: Dyed = {
  dyes: [colours(RED), colours(GREY)],
  blocks: [
    {
      first: 1,
      runs: [
        [5, 0],
        [3, 2],
      ],
    },
    { first: 10, runs: [[1, 1]] },
  ],
};

/** What each row has after the changes that are called. */
function followed(table: TreeTable) {
  const dyes = new RowDyes();
  const has = new Array<number>(SMALL.length).fill(0);
  let calls = 0;
  const follow = (tableChanged: boolean) =>
    dyes.assign(
      table,
      (row) => {
        has[row] = dyes.of(row);
        calls += 1;
      },
      tableChanged,
    );
  return { dyes, has, follow, calls: () => calls };
}

describe("the dyes of rows", () => {
  it("are those of their blocks, and those of what bears them", () => {
    const { dyes, has, follow } = followed(tableOf(SMALL));
    dyes.tell(LIMBS);
    follow(false);
    // Row 9 goes on from the limb, row 11 from the twig; rows 12 and 13 stand on the trunk.
    expect(has).toEqual([0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 1, 1, 0, 0]);
    expect(dyes.uniform.value[1]!.toArray()).toEqual(RED.bark);
    expect(dyes.uniform.value[DYES + 1]!.toArray()).toEqual(RED.leaves);
    expect(dyes.uniform.value[0]!.toArray()).toEqual([1, 1, 1]);
  });

  it("go when none are told any more", () => {
    const { dyes, has, follow } = followed(tableOf(SMALL));
    dyes.tell(LIMBS);
    follow(false);
    dyes.tell(UNDYED);
    follow(false);
    expect(has).toEqual(new Array(SMALL.length).fill(0));
  });

  it("are given to rows that are appended, and asked for only where something has changed", () => {
    const table = tableOf(SMALL.slice(0, 8));
    const { dyes, has, follow, calls } = followed(table);
    dyes.tell(LIMBS);
    follow(false);
    expect(has.slice(6, 8)).toEqual([2, 2]);
    const before = calls();
    follow(false);
    expect(calls()).toBe(before);
    tableOf(SMALL, table);
    follow(true);
    expect(has.slice(6)).toEqual([2, 2, 2, 2, 1, 1, 0, 0]);
  });

  it("may be told of rows that are not there yet", () => {
    const { dyes, has, follow } = followed(tableOf(SMALL.slice(0, 3)));
    dyes.tell(LIMBS);
    follow(false);
    expect(has).toEqual(new Array(SMALL.length).fill(0));
  });

  it("of rows that are gone are not those of others in their place", () => {
    const { dyes, follow } = followed(tableOf(SMALL));
    dyes.tell(LIMBS);
    follow(false);
    dyes.truncate(7);
    dyes.tell(UNDYED);
    expect(SMALL.map((_, row) => dyes.of(row))).toEqual([0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0]);
    follow(false);
    expect(SMALL.map((_, row) => dyes.of(row))).toEqual(SMALL.map(() => 0));
  });

  it("lie in one number with slot and light, and none of the three changes another", () => {
    const table = tableOf(SMALL);
    const nodes = new NodeTexture({ of: () => 15 });
    nodes.reserve(table.rows);
    nodes.write(table, 10);
    nodes.setSlot(table, 10, -4095);
    const number = (nodes.uniform.value.image.data as Float32Array)[12 * 10 + 7]!;
    const whole = Math.floor(-number);
    expect([Math.floor(whole / DYES), whole % DYES]).toEqual([4095, 15]);
    expect(-number - whole).toBe(table.light[10]! / 256);
  });
});
