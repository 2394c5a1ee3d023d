import { afterEach, describe, expect, it, vi } from "vitest";
import { frontView, SMALL, tableOf } from "../../../../test/small-tree";
import type { CutOverlay } from "../../../scene/overlay/cut-overlay";
import type { Command } from "../../../wire/generated";
import { CutLine } from "./cut-line";
import { PruneRule } from "./prune-rule";
import { PruneTool } from "./prune-tool";

afterEach(() => vi.useRealTimers());

function setUp(limits: readonly number[] = []) {
  vi.useFakeTimers();
  const table = tableOf(SMALL);
  const view = frontView(table);
  const sent: Command[] = [];
  const said: string[] = [];
  const predicted: (readonly number[])[] = [];
  const world = { unsettled: 0 };
  const tool = new PruneTool({
    table,
    view,
    submit: (command) => void sent.push(command),
    unsettled: () => world.unsettled,
    limits: () => new Set(limits),
    say: (sentence) => void said.push(sentence),
    predict: (rows) => void predicted.push(rows),
  });
  const draw = (...points: (readonly [number, number])[]) => {
    const [first, ...rest] = points.map(([x, y]) => ({ x, y, pressure: null }));
    tool.begin(first!);
    tool.move(rest);
  };
  const looks = () =>
    [...view.overlays].map((overlay) => [(overlay as CutOverlay).look, ...(overlay as CutOverlay).rows]);
  return { table, view, tool, sent, said, predicted, world, draw, looks };
}

describe("PR1: where a branch comes off", () => {
  const rule = (...limits: number[]) => new PruneRule(tableOf(SMALL), new Set(limits));

  it("at the branching point below", () => {
    expect([9, 8, 7, 6, 11, 13].map((row) => rule().cutsAt(row))).toEqual([[8], [8], [6], [6], [10], [12]]);
    expect(
      [5, 4].map((row) => rule().cutsAt(row)),
      "a trunk's top above a branch",
    ).toEqual([[4], [4]]);
  });

  it("the trunk below every branch does not", () => {
    expect([1, 2, 0].map((row) => rule().cutsAt(row))).toEqual([[], [], []]);
  });

  it("a branch that has died is no branching point", () => {
    const table = tableOf(SMALL.map((twig, row) => (row >= 10 && row <= 11 ? { ...twig, dead: true } : twig)));
    expect(new PruneRule(table, new Set()).cutsAt(9)).toEqual([6]);
    expect(new PruneRule(table, new Set()).cutsAt(11)).toEqual([]);
  });

  it("a width that is set keeps a stub", () => {
    expect(rule(6).cutsAt(7)).toEqual([7]);
    expect(rule(10).cutsAt(11)).toEqual([11]);
    expect(rule(7).cutsAt(7), "all that is above it").toEqual([8, 10]);
    expect(rule(8).cutsAt(9), "a width on the cut itself").toEqual([9]);
    expect(rule(9).cutsAt(9), "nothing is above it").toEqual([]);
    expect(rule(1).cutsAt(2), "even of the trunk").toEqual([2]);
  });

  it("what is above another cut is not cut again", () => {
    expect(rule().cutsAtAll([11, 6, 13, 9])).toEqual([6, 12]);
  });

  it("PR3: a branch is dim if nothing on it is bright", () => {
    expect([0, 0.05, 0.1, 0.12, 0.9].map((exposure) => rule().dim(exposure))).toEqual([
      [],
      [12],
      [12],
      [10, 12],
      [6, 12],
    ]);
  });
});

describe("a line through branches", () => {
  it("crosses each metamer once, also at its ends", () => {
    const table = tableOf(SMALL);
    const { placeOf, projector } = frontView(table);
    const line = new CutLine(table, placeOf, projector());
    expect(line.to(650, 800), "it begins somewhere").toEqual([]);
    expect(line.to(650, 600)).toEqual([7]);
    expect(line.to(750, 550)).toEqual([11]);
    const through = new CutLine(table, placeOf, projector());
    through.to(600, 800);
    expect(through.to(600, 600), "where two meet").toHaveLength(1);
    through.to(480, 650);
    expect(through.to(520, 650), "across the trunk").toEqual([3]);
  });

  it("what it crosses is marked, then cut and hidden at once", () => {
    const { tool, sent, draw, looks } = setUp();
    draw([650, 800], [650, 600], [750, 550], [450, 550], [450, 650]);
    expect(looks()).toEqual([["marked", 4, 6, 12]]);
    expect([sent, tool.line.value?.length]).toEqual([[], 5]);
    tool.end();
    expect(sent).toEqual([{ kind: "prune", rows: [7, 11, 4, 12] }]);
    expect([looks(), tool.line.value]).toEqual([[["hidden", 4, 6, 12]], null]);
  });

  it("crosses what it is seen to cross while the wind moves it, and the wind hears of the cut", () => {
    const { tool, sent, view } = setUp();
    const at = (x: number, y: number) => ({ x, y, pressure: null });
    view.wind.carries = -0.4;
    tool.begin(at(650, 800));
    view.wind.carries = 1;
    tool.move([at(650, 600)]);
    expect(tool.marked.value, "the limb that the wind carries there").toBe(1);
    tool.end();
    expect(sent).toEqual([{ kind: "prune", rows: [6] }]);
    expect(view.wind.cuts).toEqual([[6]]);
  });

  it("the trunk is left out, and alone it is explained", () => {
    const { tool, sent, said, draw } = setUp();
    draw([480, 850], [520, 850]);
    tool.end();
    expect([sent, said.length]).toEqual([[], 1]);
    draw([480, 850], [520, 850], [660, 850], [660, 600]);
    tool.end();
    expect(sent).toEqual([{ kind: "prune", rows: [7] }]);
  });

  it("a cancelled line cuts nothing", () => {
    const { tool, sent, draw, looks } = setUp();
    draw([650, 800], [650, 600]);
    tool.abandon();
    expect([sent, looks(), tool.line.value]).toEqual([[], [], null]);
  });
});

describe("marks that are asked for", () => {
  it("last until others are, whatever the shears are at, and tell where nothing can be cut", () => {
    const { tool, looks } = setUp();
    expect(tool.mark([1, 9, 11])).toEqual({ cuts: [8, 10], kept: 1 });
    tool.hover(602, 700);
    tool.leave();
    expect(looks()).toEqual([["marked", 8, 10]]);
    expect(tool.marked.value, "the shears are at nothing").toBe(0);
    expect(tool.mark([2])).toEqual({ cuts: [], kept: 1 });
    expect(looks()).toEqual([]);
  });
});

describe("shears", () => {
  it("a tap cuts the branch that is there", () => {
    const { tool, sent, draw, looks } = setUp();
    draw([602, 700]);
    tool.end();
    expect([sent, looks()]).toEqual([[{ kind: "prune", rows: [6] }], [["hidden", 6]]]);
    expect([tool.cutAt(900, 100), sent.length]).toEqual([false, 1]);
  });

  it("in prediction mode cut nothing, by tap or by line", () => {
    const { tool, sent, predicted, draw, looks } = setUp();
    tool.predicts.value = true;
    draw([602, 700]);
    tool.end();
    draw([650, 800], [650, 600], [750, 550], [450, 550], [450, 650]);
    tool.end();
    expect([sent, predicted, looks()]).toEqual([[], [[6], [4, 6, 12]], []]);
    tool.cut([6]);
    expect(sent, "the menu of a branch cuts all the same").toHaveLength(1);
  });

  it("a pointer over a branch shows what would go", () => {
    const { tool, looks } = setUp();
    tool.hover(700, 700);
    expect(looks()).toEqual([["marked", 6]]);
    tool.hover(300, 600);
    expect(looks()).toEqual([["marked", 12]]);
    tool.leave();
    expect(looks()).toEqual([]);
  });

  it("what is refused comes back", () => {
    const { tool, looks } = setUp();
    tool.cutAt(700, 700);
    tool.refused({ kind: "undo" });
    expect(looks(), "something else was refused").not.toEqual([]);
    tool.refused({ kind: "prune", rows: [6] });
    expect(looks()).toEqual([]);
  });

  it("what was cut is no longer hidden once its rows are dead", () => {
    const { table, tool, view, world, looks } = setUp();
    tool.cutAt(700, 700);
    world.unsettled = 1;
    tool.changed();
    vi.advanceTimersByTime(5000);
    expect(looks(), "as long as the server has not answered").toEqual([["hidden", 6]]);
    tableOf(
      SMALL.map((twig, row) => (row >= 6 && row <= 11 ? { ...twig, dead: true } : twig)),
      table,
    );
    view.overlays.clear();
    world.unsettled = 0;
    tool.changed();
    vi.advanceTimersByTime(5000);
    expect(looks()).toEqual([]);
  });

  it("what was answered and is still there was not cut", () => {
    const { tool, looks } = setUp();
    tool.cutAt(700, 700);
    tool.changed();
    vi.advanceTimersByTime(5000);
    expect(looks()).toEqual([]);
  });

  it("all that stands in the dark goes at once", () => {
    const { tool, sent, looks } = setUp();
    expect([tool.markDim(0.12), looks()]).toEqual([2, [["marked", 10, 12]]]);
    tool.cutDim(0.12);
    expect(sent).toEqual([{ kind: "prune_dim", exposure: 0.12 }]);
    expect(looks()).toEqual([["hidden", 10, 12]]);
    expect([tool.markDim(null), tool.marked.value]).toEqual([0, 0]);
  });
});
