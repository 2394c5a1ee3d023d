import { describe, expect, it } from "vitest";
import { ChosenBud } from "./chosen-bud";

const rows = () => ({ rows: 3, position: [0, 0, 0, 0, 1, 0, 1, 2, 0], radiusCode: [0, 40, 30] });

describe("chosen bud", () => {
  it("stays while its metamer lives", () => {
    const table = rows();
    const bud = new ChosenBud(table);
    expect(bud.keep(), "nothing chosen, nothing lost").toBe(true);
    bud.choose(2);
    table.rows = 9;
    expect([bud.keep(), bud.row.value]).toEqual([true, 2]);
  });

  it.each([
    ["its row is gone", (table: ReturnType<typeof rows>) => (table.rows = 2)],
    ["it is shed", (table: ReturnType<typeof rows>) => (table.radiusCode[2] = 0)],
    ["another metamer has its row", (table: ReturnType<typeof rows>) => (table.position[7] = 5)],
  ])("is released when %s", (_, change) => {
    const table = rows();
    const bud = new ChosenBud(table);
    bud.choose(2);
    change(table);
    expect([bud.keep(), bud.row.value, bud.keep()]).toEqual([false, null, true]);
  });
});
