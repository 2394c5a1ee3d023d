import { expect, it } from "vitest";
import type { OperationKind, TimelineOperation } from "../../../wire/generated";
import { ownDeeds } from "./own-deeds";

/** A line of single deeds: who did what, `-` for those that are away. Number 1 is at the page. */
function line(...all: string[]): TimelineOperation[] {
  const kinds: Record<string, OperationKind> = { s: "stroke", t: "taken_back", b: "brought_back" };
  return all.map((one) => ({
    kind: kinds[one[0]!]!,
    author: Number(one[1]),
    first: 0,
    last: 1,
    ...(one.endsWith("-") ? { away: true } : {}),
  }));
}

function next(...all: string[]) {
  const operations = line(...all);
  const { back, forth } = ownDeeds({ operations, done: operations.length }, 1);
  return [back, forth];
}

it("UD1: undo takes back one's own newest deed in force, also behind what others did", () => {
  expect(next("s1", "s2")).toEqual([0, null]);
  expect(next("s2", "s2")).toEqual([null, null]);
  expect(next("s1", "s1-", "s2", "t1")).toEqual([0, 1]);
  // Nothing of the newer one could go, so that it was passed over.
  expect(next("s1-", "s1", "s2", "t1")[0]).toBe(1);
});

it("UD3: redo brings back what one took back last, unless one did something since", () => {
  expect(next("s1-", "s1-", "s2", "t1", "t1")).toEqual([null, 0]);
  expect(next("s1", "s1-", "s2", "t1", "t1", "b1")).toEqual([0, 1]);
  expect(next("s1-", "s2", "t1", "s1")).toEqual([3, null]);
  expect(next("s1-", "s2", "t1", "s2"), "others may do what they like").toEqual([null, 0]);
  expect(next("s1-", "s1-", "s2", "t1", "s1-", "t1", "t1"), "what was away already is not taken back again").toEqual([
    null,
    0,
  ]);
});

it("UD4: where several drew at once, the part that is one's own counts", () => {
  const joint = (away: boolean): TimelineOperation => ({
    ...line("s2")[0]!,
    parts: [{ author: 2 }, { author: 1, away }],
  });
  const of = (...operations: TimelineOperation[]) => ownDeeds({ operations, done: operations.length }, 1);
  expect(of(joint(false))).toEqual({ isAlone: false, back: 0, forth: null });
  expect(of(joint(true), ...line("t1"))).toEqual({ isAlone: false, back: null, forth: 0 });
});

it("UD4: on a line of one person the two go back and forth", () => {
  const operations = line("s1", "s1", "s1");
  expect(ownDeeds({ operations, done: 2 }, 1)).toEqual({ isAlone: true, back: 1, forth: 2 });
  expect(ownDeeds({ operations, done: 2 }, null), "whoever that is").toMatchObject({ isAlone: true });
  expect(ownDeeds({ operations, done: 3 }, 2)).toEqual({ isAlone: false, back: null, forth: null });
});
