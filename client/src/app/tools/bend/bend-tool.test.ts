import { afterEach, describe, expect, it, vi } from "vitest";
import { frontView, SMALL, tableOf } from "../../../../test/small-tree";
import type { BendOverlay } from "../../../scene/overlay/bend-overlay";
import type { Vec3 } from "../../../scene/vector";
import type { Command } from "../../../wire/generated";
import { holdAt, naturalBase, related } from "./bend-hold";
import { BendTool } from "./bend-tool";

afterEach(() => vi.useRealTimers());

function setUp() {
  const table = tableOf(SMALL);
  const view = frontView(table);
  const sent: Command[] = [];
  const said: string[] = [];
  const solvers: { nodes: Vec3[]; dragged: (readonly (readonly [number, Vec3])[])[]; relaxed: number }[] = [];
  const world = { unsettled: 0 };
  const tool = new BendTool({
    table,
    view,
    submit: (command) => void sent.push(command),
    newBend: () => sent.length + 1,
    newGesture: () => 100 + sent.length,
    unsettled: () => world.unsettled,
    stretch: () => 0.5,
    say: (sentence) => void said.push(sentence),
    // Puts what is dragged where it is wanted and leaves the rest.
    solver: (nodes) => {
      const state = { nodes, dragged: [] as (readonly (readonly [number, Vec3])[])[], relaxed: 0 };
      solvers.push(state);
      return {
        drag: (targets) => void state.dragged.push([...targets]),
        relax: () => {
          state.relaxed += 1;
        },
        motions: () =>
          nodes.slice(1).map((rest, i) => {
            const pulled = state.dragged.at(-1)?.find(([internode]) => internode === i);
            return { rotation: [0, 0, 0, 1] as const, to: pulled?.[1] ?? rest };
          }),
      };
    },
  });
  const at = (row: number) => view.glass(view.placeOf(row));
  const finger = (id: number) => ({
    down: (row: number) => tool.gripBegin(id, ...at(row), 5),
    by: (dx: number, dy: number, row: number) => tool.gripMove(id, at(row)[0] + dx, at(row)[1] + dy),
    up: () => tool.gripEnd(id),
  });
  const tap = (row: number) => {
    finger(9).down(row);
    finger(9).up();
  };
  return { table, view, tool, sent, said, solvers, world, finger, tap, at };
}

const kinds = (commands: Command[]) => commands.map(({ kind }) => kind);

describe("what is held", () => {
  const table = tableOf(SMALL);

  it("the path leads to the farthest touch, others on it are kept", () => {
    expect(holdAt(table, 2, [7, 9, 13])).toEqual({ path: [2, 6, 7, 8, 9], touches: [7, 9] });
    expect(holdAt(table, 2, [13])).toEqual({ path: [2, 3, 12, 13], touches: [13] });
    expect([holdAt(table, 6, [13]), holdAt(table, 6, [6]), holdAt(table, 9, [7])]).toEqual([null, null, null]);
  });

  it("a branch taken alone bends from the wood that bears it", () => {
    expect([naturalBase(table, 9), naturalBase(table, 11), naturalBase(table, 4)]).toEqual([2, 7, 1]);
    expect([related(table, 2, 11), related(table, 11, 2), related(table, 9, 11)]).toEqual([true, true, false]);
  });
});

describe("bending", () => {
  it("three fingers hold the base, the end and a place between", () => {
    const { tool, sent, solvers, finger, view, at } = setUp();
    finger(1).down(2);
    expect(tool.takes(...at(9))).toBe("take");
    finger(2).down(9);
    finger(3).down(7);
    expect(sent, "nothing moves before a finger does").toEqual([]);
    finger(2).by(0, -100, 9);
    finger(3).by(0, -20, 7);
    tool.tick();
    finger(1).up();
    finger(2).up();
    expect(kinds(sent)).toEqual(["bend_begin", "bend_move"]);
    expect(sent[0]).toEqual({ kind: "bend_begin", bend: 1, base: 2, touches: [9, 7], stretch: 0.5, gesture: 100 });
    expect(sent[1]).toEqual({
      kind: "bend_move",
      bend: 1,
      targets: [
        [4, 3, 0],
        [2, 2.2, 0],
      ],
    });
    finger(3).up();
    expect(kinds(sent).at(-1)).toBe("bend_end");
    expect(solvers[0]).toMatchObject({
      relaxed: 1,
      nodes: [
        [0, 1, 0],
        [0, 2, 0],
        [1, 2, 0],
        [2, 2, 0],
        [3, 2, 0],
        [4, 2, 0],
      ],
    });
    expect(view.overlays.size, "the bend stays until the rows have it").toBe(1);
  });

  it("the lowest finger holds the base, whichever came first", () => {
    const { sent, finger } = setUp();
    finger(1).down(9);
    finger(2).down(6);
    finger(1).by(30, 0, 9);
    expect(sent[0]).toMatchObject({ base: 6, touches: [9] });
  });

  it("one pointer marks a base, sets what stays put, and drags", () => {
    const { tool, sent, finger, tap } = setUp();
    tap(2);
    expect([tool.base.value, sent]).toEqual([2, []]);
    tap(7);
    expect(tool.handles.value).toEqual([7]);
    finger(1).down(9);
    finger(1).by(50, 50, 9);
    tool.tick();
    finger(1).up();
    expect(sent[0]).toMatchObject({ base: 2, touches: [9, 7] });
    expect(sent[1]).toMatchObject({
      targets: [
        [4.5, 1.5, 0],
        [2, 2, 0],
      ],
    });
    expect([tool.base.value, tool.handles.value], "for the next drag").toEqual([2, [7]]);
  });

  it("where the wind has carried a branch is no part of its bend, and it is let go to swing", () => {
    const { tool, sent, view, at } = setUp();
    view.wind.carries = 0.4;
    const [x, y] = [at(9)[0] + 40, at(9)[1]];
    expect(view.pick(x, y, 1)?.row, "the finger is where it is seen").toBe(9);
    tool.gripBegin(1, x, y, 5);
    tool.gripMove(1, x + 20, y);
    expect(sent.find(({ kind }) => kind === "bend_begin")).toMatchObject({ touches: [9] });
    tool.gripMove(1, x + 50, y - 50);
    expect(view.wind.released).toEqual([]);
    tool.gripEnd(1);
    const moved = sent.flatMap((command) => (command.kind === "bend_move" ? [command] : [])).at(-1);
    expect(moved?.targets[0]?.[0]).toBeCloseTo(4 + 0.5);
    expect(moved?.targets[0]?.[1]).toBeCloseTo(2 + 0.5);
    expect(view.wind.released).toEqual([[2, 6, 7, 8, 9]]);
  });

  it("a second tap on the same place lets go of it", () => {
    const { tool, tap } = setUp();
    tap(2);
    tap(7);
    tap(7);
    expect([tool.base.value, tool.handles.value]).toEqual([2, []]);
    tap(2);
    expect(tool.base.value).toBeNull();
    tap(9);
    tap(13);
    expect(tool.base.value, "beside the branch is another base").toBe(13);
    expect([tool.release(), tool.release()]).toEqual([true, false]);
  });

  it("without a marked base a branch bends where it is borne", () => {
    const { sent, finger } = setUp();
    finger(1).down(11);
    finger(1).by(9, 0, 11);
    expect(sent[0]).toMatchObject({ base: 7, touches: [11] });
  });

  it("two fingers on branches apart move the view", () => {
    const { tool, finger, at } = setUp();
    expect(tool.takes(900, 100), "one alone may tap beside everything").toBe("take");
    finger(1).down(9);
    expect([tool.takes(...at(13)), tool.takes(900, 100), tool.takes(...at(2))]).toEqual(["leave", "leave", "take"]);
    finger(1).by(30, 0, 9);
    expect([tool.takes(...at(13)), tool.takes(...at(7))], "while it bends").toEqual(["ignore", "take"]);
  });

  it("a finger that rests has the branch come up to it", () => {
    const { tool, sent, finger } = setUp();
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    for (let i = 0; i < 20; i += 1) tool.tick();
    expect(kinds(sent).filter((kind) => kind === "bend_move")).toHaveLength(9);
  });

  it("a server that is behind is not hurried", () => {
    const { tool, sent, world, finger } = setUp();
    world.unsettled = 6;
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    tool.tick();
    expect(kinds(sent)).toEqual(["bend_begin"]);
    finger(1).up();
    expect(kinds(sent), "the last place is never lost").toEqual(["bend_begin", "bend_move", "bend_end"]);
  });

  it("Escape puts the branch back", () => {
    const { tool, sent, view, finger } = setUp();
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    tool.cancel();
    finger(1).by(60, 0, 9);
    finger(1).up();
    expect([kinds(sent), view.overlays.size]).toEqual([["bend_begin", "bend_cancel"], 0]);
  });

  it("a bend that is refused is shown no more", () => {
    const { tool, sent, view, finger } = setUp();
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    tool.refused(sent[0]!);
    finger(1).by(60, 0, 9);
    tool.tick();
    expect([kinds(sent), view.overlays.size]).toEqual([["bend_begin"], 0]);
  });

  it("the next bend waits until the last is in the table", () => {
    const { table, tool, sent, view, finger } = setUp();
    finger(1).down(9);
    finger(1).by(0, -100, 9);
    finger(1).up();
    const before = sent.length;
    finger(1).down(9);
    finger(1).by(0, -50, 9);
    expect(sent).toHaveLength(before);
    tableOf(
      SMALL.map((twig, row) => (row === 9 ? { ...twig, at: [4, 3, 0] as const } : twig)),
      table,
    );
    tool.changed();
    view.overlays.clear();
    finger(1).by(0, -60, 9);
    expect(sent[before]).toMatchObject({ kind: "bend_begin" });
  });

  it("a finger that joins later bends on from there", () => {
    const { table, tool, sent, view, finger } = setUp();
    finger(1).down(2);
    finger(2).down(9);
    finger(2).by(0, -100, 9);
    finger(3).down(7);
    expect(kinds(sent)).toEqual(["bend_begin", "bend_move", "bend_end"]);
    finger(2).by(0, -120, 9);
    expect(sent, "the last move is on its way").toHaveLength(3);
    tableOf(
      SMALL.map((twig, row) => (row === 9 ? { ...twig, at: [4, 3, 0] as const } : twig)),
      table,
    );
    view.overlays.clear();
    tool.changed();
    tool.tick();
    // A pixel up is now counted from where the end has come to.
    finger(2).by(0, -50, 9);
    finger(3).by(0, 30, 7);
    tool.tick();
    expect(sent.slice(3)).toMatchObject([
      { kind: "bend_begin", base: 2, touches: [9, 7], gesture: 100 },
      {
        kind: "bend_move",
        targets: [
          [4, 3.3, 0],
          [2, 1.7, 0],
        ],
      },
    ]);
    expect(sent[0], "one operation for undo").toMatchObject({ gesture: 100 });
    for (const id of [1, 2, 3]) {
      finger(id).up();
    }
    tableOf(
      SMALL.map((twig, row) => (row === 9 ? { ...twig, at: [5, 3, 0] as const } : twig)),
      table,
    );
    view.overlays.clear();
    tool.changed();
    const before = sent.length;
    finger(1).down(9);
    finger(1).by(0, -50, 9);
    expect(sent[before], "another touch, another operation").toMatchObject({ gesture: 100 + before });
  });

  it("a bend that comes to nothing is not waited for", () => {
    vi.useFakeTimers();
    const { tool, view, world, finger } = setUp();
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    finger(1).up();
    world.unsettled = 1;
    tool.changed();
    vi.advanceTimersByTime(9000);
    expect(view.overlays.size).toBe(1);
    world.unsettled = 0;
    tool.changed();
    vi.advanceTimersByTime(9000);
    expect(view.overlays.size).toBe(0);
  });

  it("a branch that is gone ends its bend and unmarks what was marked", () => {
    const { table, tool, said, view, finger, tap } = setUp();
    tap(6);
    tap(8);
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    tableOf(
      SMALL.map((twig, row) => (row >= 6 && row <= 11 ? { ...twig, dead: true } : twig)),
      table,
    );
    tool.changed();
    expect([view.overlays.size, tool.base.value, said.length]).toEqual([0, null, 1]);
  });

  it("its own bend is known by its path, and ends with the server's", () => {
    const { view, finger, tool } = setUp();
    finger(1).down(9);
    finger(1).by(30, 0, 9);
    const [overlay] = view.overlays as Set<BendOverlay>;
    expect([tool.owns([2, 6, 7, 8, 9]), tool.owns([2, 6, 7])]).toEqual([true, false]);
    expect(overlay?.follows([2, 6, 7, 8, 9])).toBe(true);
    tool.over([2, 6, 7, 8, 9]);
    expect(view.overlays.size, "the server gave it up").toBe(0);
  });
});
