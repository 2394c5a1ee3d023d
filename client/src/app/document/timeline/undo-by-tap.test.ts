import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Command, OperationKind, Timeline } from "../../../wire/generated";
import { undoByTap } from "./undo-by-tap";

function setUp(kinds: readonly OperationKind[], done: number, step = 10 * done) {
  const operations = kinds.map((kind, i) => ({ kind, author: "", first: 10 * i, last: 10 * (i + 1) }));
  const timeline = {
    line: 0,
    step,
    last_step: 10 * kinds.length,
    done,
    operations,
    futures: [],
  } as unknown as Timeline;
  const sent: Command["kind"][] = [];
  const said: string[] = [];
  const page = {
    document: signal({ can_undo: done > 0, can_redo: done < kinds.length || step < 10 * done }),
    time: { timeline: signal(timeline) },
    toasts: { show: (text: string) => said.push(text) },
    submit: ({ kind }: Command) => sent.push(kind),
  };
  return { tap: (fingers: number) => undoByTap(page, fingers), sent, said };
}

describe("a tap of several fingers", () => {
  it("undoes with two and redoes with three, and says what", () => {
    const { tap, sent, said } = setUp(["stroke", "prune", "growth"], 2);
    tap(2);
    tap(3);
    expect(sent).toEqual(["undo", "redo"]);
    expect(said).toEqual(["Undone: Pruning", "Redone: Growth"]);
  });

  it("redoes the rest of what was left in part", () => {
    const { tap, said } = setUp(["stroke", "prune"], 1, 4);
    tap(3);
    expect(said).toEqual(["Redone: Stroke"]);
  });

  it("says where there is nothing, and does nothing with other numbers", () => {
    const { tap, sent, said } = setUp([], 0);
    tap(2);
    tap(3);
    tap(4);
    expect(said).toEqual(["There is nothing to undo.", "There is nothing to redo."]);
    expect(sent).toEqual([]);
  });
});
