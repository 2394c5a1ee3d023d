import { describe, expect, it } from "vitest";
import { frontView, SMALL, tableOf } from "../../../../test/small-tree";
import type { BendOverlay } from "../../../scene/overlay/bend-overlay";
import { OthersBends } from "./others-bends";

function setUp(own: readonly number[] = []) {
  const table = tableOf(SMALL);
  const view = frontView(table);
  const over: (readonly number[])[] = [];
  const bends = new OthersBends(table, view, {
    owns: (path) => path.join() === own.join(),
    over: (path) => void over.push(path),
  });
  let sequence = 0;
  const receive = (bend: number, ...path: number[]) => {
    sequence += 1;
    const motions = path.map((row) => ({ row, rotation: [0, 0, 0, 1], to: [row, 1, 2] }) as const);
    bends.receive({
      epoch: 1,
      sequence,
      bend,
      motions: motions.map(({ row, rotation, to }) => ({ row, rotation: [...rotation], to: [...to] })),
    });
  };
  return { table, view, bends, over, receive };
}

describe("BE5: bends of other people", () => {
  it("are shown from the first frame to the one without motions", () => {
    const { view, receive } = setUp();
    receive(7, 2, 6, 7);
    receive(7, 2, 6, 7);
    receive(8, 3, 12);
    expect([...view.overlays].map((overlay) => (overlay as BendOverlay).path)).toEqual([
      [2, 6, 7],
      [3, 12],
    ]);
    receive(7);
    expect([...view.overlays].map((overlay) => (overlay as BendOverlay).path)).toEqual([[3, 12]]);
  });

  it("one of this page is left to it, and ended when it is over", () => {
    const { view, over, receive } = setUp([2, 6, 7]);
    receive(7, 2, 6, 7);
    receive(7);
    expect([view.overlays.size, over]).toEqual([0, [[2, 6, 7]]]);
  });

  it("are put on anew after the rows have moved under them", () => {
    const { table, view, receive } = setUp();
    receive(7, 2, 6, 7);
    tableOf(
      SMALL.map((twig, row) => (row === 7 ? { ...twig, at: [2, 2.5, 0] as const } : twig)),
      table,
    );
    view.overlays.clear();
    receive(7, 2, 6, 7);
    expect(view.overlays.size).toBe(1);
    expect(([...view.overlays][0] as BendOverlay).over(table)).toBe(false);
  });

  it("a path that the rows do not have is not drawn", () => {
    const { view, receive } = setUp();
    receive(7, 2, 7);
    receive(8, 13, 14);
    expect(view.overlays.size).toBe(0);
  });

  it("are forgotten with the connection", () => {
    const { view, bends, over, receive } = setUp([3, 12]);
    receive(7, 2, 6, 7);
    receive(8, 3, 12);
    bends.clear();
    receive(8);
    expect([view.overlays.size, over]).toEqual([0, []]);
  });
});
