import { expect, it } from "vitest";
import type { Comment, Pin, Thread } from "../../wire/generated";
import { authorsOf, type By, callsForMe, FILTERS, isUnread, isWanted, nameOf, newCalls, unreadIn } from "./filters";

function comment(number: number, author: string, rest: Partial<Comment> = {}): Comment {
  const written_at = "2026-05-01T12:00:00.000Z";
  return { comment: number, author, own: false, written_at, text: "?", mentions: [], picture: false, ...rest };
}

function thread(number: number, comments: Comment[], rest: Partial<Thread> = {}): Thread {
  return { thread: number, seen: 0, comments, ...rest };
}

const AT = { along: 0.5, offset: [0, 0, 0], place: [0, 1, 0] } as unknown as NonNullable<Thread["at"]>;
const THREADS = [
  thread(1, [comment(1, "Ann", { own: true }), comment(2, "Bo")], { seen: 1, at: AT }),
  thread(2, [comment(1, "Bo", { mentions: [{ name: "ANN", you: true }] })], { seen: 1 }),
  thread(3, [comment(1, "Cy")], { seen: 1, at: AT, resolved: { by: "Bo", at: "2026" } }),
  thread(4, [comment(1, "Ann")], { seen: 1, at: AT }),
  thread(5, [comment(1, "Bo")], { seen: 1, at: AT }),
  thread(6, [comment(1, "Bo")], { seen: 1, at: AT }),
];
const PINS = new Map<number, Pin>([
  [1, { thread: 1, state: "standing", row: 4 }],
  [3, { thread: 3, state: "detached" }],
  [4, { thread: 4, state: "regrown", row: 9 }],
  [5, { thread: 5, state: "elsewhere", step: 3, line: 1 }],
  [6, { thread: 6, state: "not_yet", step: 8 }],
]);

it.each([
  ["open", [1, 2, 4, 5, 6]],
  ["mentions", [2]],
  ["unread", [1]],
  ["regrown", [4]],
  ["detached", [3, 5]],
  ["all", [1, 2, 3, 4, 5, 6]],
] as const)("CT2, CT4: %s shows threads %j", (filter, expected) => {
  const shown = THREADS.filter((one) => isWanted(one, PINS.get(one.thread), { filter, by: "anybody" }));
  expect(shown.map((one) => one.thread)).toEqual(expected);
});

it("CT2: a thread about the tree as a whole has no place that could be lost, or found again", () => {
  const whole = thread(7, [comment(1, "Bo")]);
  const filters = (["detached", "regrown"] as const).filter((filter) =>
    isWanted(whole, { thread: 7, state: filter }, { filter, by: "anybody" }),
  );
  expect(filters).toEqual([]);
});

it("CT4: threads of a person are those in which they have said something", () => {
  const of = (by: By) =>
    THREADS.filter((one) => isWanted(one, undefined, { filter: "all", by })).map((one) => one.thread);
  expect([of("other Bo"), of("other Cy"), of("other Ed")]).toEqual([[1, 2, 5, 6], [3], []]);
});

it("CT1: whoever looks is told apart from others of the same name, and comes first", () => {
  const of = (by: By) =>
    THREADS.filter((one) => isWanted(one, undefined, { filter: "all", by })).map((one) => one.thread);
  expect([of("own"), of("other Ann")]).toEqual([[1], [4]]);
  expect(authorsOf(THREADS)).toEqual(["own", "other Ann", "other Bo", "other Cy"]);
  expect(authorsOf(THREADS.slice(1)).map(nameOf)).toEqual(["Ann", "Bo", "Cy"]);
  const called = thread(8, [comment(1, "own")]);
  expect([isWanted(called, undefined, { filter: "all", by: "own" }), authorsOf([called])]).toEqual([
    false,
    ["other own"],
  ]);
});

it("CT4: what somebody has said may be looked for among what is of one kind", () => {
  const of = (filter: (typeof FILTERS)[number], by: By) =>
    THREADS.filter((one) => isWanted(one, PINS.get(one.thread), { filter, by })).map((one) => one.thread);
  expect([of("detached", "other Bo"), of("open", "own"), of("regrown", "own")]).toEqual([[5], [1], []]);
});

it("CT4: nothing of one's own is unread", () => {
  expect(isUnread(thread(9, [comment(1, "Ann", { own: true })]))).toBe(false);
  expect(FILTERS).toHaveLength(6);
});

it("CT4: what was not seen is counted, and told apart where it is for whoever looks", () => {
  const mentions = [{ name: "Ann as she was called", you: true }];
  const both = thread(9, [comment(1, "Bo", { mentions }), comment(2, "Bo"), comment(3, "Cy")], { seen: 1 });
  expect(unreadIn(both).map(({ comment }) => comment)).toEqual([2, 3]);
  expect([callsForMe(both), callsForMe({ ...both, seen: 0 })]).toEqual([false, true]);
  const another = thread(9, [comment(1, "Bo", { mentions: [{ name: "Ann", you: false }] })]);
  expect(callsForMe(another)).toBe(false);
});

it("CT4: whoever is named is called by what was just said, and by nothing that was there or that they have seen", () => {
  const mentions = [{ name: "Ann", you: true }];
  const before = thread(9, [comment(1, "Bo", { mentions }), comment(2, "Bo")]);
  const answer = comment(3, "Cy", { mentions });
  const after = { ...before, comments: [...before.comments, answer] };
  expect(newCalls(before, after)).toEqual([answer]);
  expect(newCalls(undefined, after).map(({ comment }) => comment)).toEqual([1, 3]);
  expect(newCalls(before, { ...after, seen: 3 })).toEqual([]);
  expect(newCalls(before, { ...before, resolved: { by: "Bo", at: "2026" } })).toEqual([]);
});
