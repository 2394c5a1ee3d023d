import { describe, expect, it } from "vitest";
import { Virtual } from "../../../test/virtual-clock";
import type { Comment, Thread } from "../../wire/generated";
import { type Deletion, Deletions, without } from "./deletions";

const first: Deletion = { tree: "oak", thread: 1, comment: 1, said: "Deleted: first" };
const second: Deletion = { ...first, comment: 2, said: "Deleted: second" };

/** Deletions, what was sent of them, and a server that answers when it is told to. */
function setUp() {
  const sent: number[] = [];
  const answers: (() => void)[] = [];
  const clock = new Virtual();
  const deletions = new Deletions({
    within: 10_000,
    clock,
    send: ({ comment }) => {
      sent.push(comment);
      return new Promise((resolve) => answers.push(resolve));
    },
  });
  const answer = async () => {
    for (const resolve of answers.splice(0)) resolve();
    await Promise.resolve();
  };
  return { deletions, sent, clock, answer };
}

describe("comments that are deleted", () => {
  it("CT5: are gone at once, and the server is told when they can no longer be brought back", async () => {
    const { deletions, sent, clock, answer } = setUp();
    deletions.begin(first);
    clock.pass(9_999);
    expect([deletions.all.value, sent]).toEqual([[first], []]);
    clock.pass(1);
    expect([deletions.all.value, sent], "until the server has answered").toEqual([[first], [1]]);
    await answer();
    expect(deletions.all.value).toEqual([]);
  });

  it("CT5: are there again when they are brought back, and the server never hears of it", () => {
    const { deletions, sent, clock } = setUp();
    deletions.begin(first);
    deletions.begin(second);
    deletions.takeBack(first);
    expect(deletions.all.value).toEqual([second]);
    clock.pass(10_000);
    expect(sent).toEqual([2]);
  });

  it("CT5: are deleted by two taps as by one", () => {
    const { deletions, sent, clock } = setUp();
    expect([deletions.begin(first), deletions.begin({ ...first })]).toEqual([true, false]);
    deletions.takeBack(first);
    expect(deletions.all.value).toEqual([]);
    clock.pass(10_000);
    expect(sent).toEqual([]);
  });

  it("CT5: are deleted when the page is left, each once", async () => {
    const { deletions, sent, clock, answer } = setUp();
    deletions.begin(first);
    deletions.begin(second);
    deletions.settleAll();
    deletions.settleAll();
    clock.pass(10_000);
    expect(sent).toEqual([1, 2]);
    deletions.takeBack(first);
    expect(deletions.all.value, "it is too late").toEqual([first, second]);
    await answer();
    expect(deletions.all.value).toEqual([]);
  });
});

describe("what is shown without them", () => {
  const comment = (number: number): Comment => ({
    comment: number,
    author: "Ann",
    own: true,
    written_at: "2026-05-01T12:00:00.000Z",
    text: "?",
    mentions: [],
    picture: false,
  });
  const thread = (number: number, comments: number[]): Thread => ({
    thread: number,
    seen: 0,
    comments: comments.map(comment),
  });
  const threads = new Map([
    [1, thread(1, [1, 2])],
    [2, thread(2, [1])],
  ]);
  const left = (tree: string | null, deletions: readonly Deletion[]) =>
    [...without(threads, tree, deletions).values()].map(({ thread, comments }) => [thread, comments.length]);

  it.each([
    [
      "an answer leaves the thread",
      "oak",
      [second],
      [
        [1, 1],
        [2, 1],
      ],
    ],
    ["a thread goes with its last comment", "oak", [{ ...first, thread: 2 }], [[1, 2]]],
    ["a thread goes with both of its comments", "oak", [first, second], [[2, 1]]],
    [
      "what is gone already changes nothing",
      "oak",
      [{ ...first, thread: 7 }],
      [
        [1, 2],
        [2, 1],
      ],
    ],
    [
      "another tree has its own",
      "elm",
      [first, second],
      [
        [1, 2],
        [2, 1],
      ],
    ],
    [
      "no tree has none",
      null,
      [first],
      [
        [1, 2],
        [2, 1],
      ],
    ],
  ] as const)("CT5: %s", (_, tree, deletions, expected) => {
    expect(left(tree, deletions)).toEqual(expected);
  });
});
