import { expect, it, vi } from "vitest";
import type { Pin } from "../../wire/generated";
import { Comments } from "./comments";
import type { Conversation } from "./conversation";

const pin = (thread: number, state: Pin["state"]): Pin => ({ thread, state });

it("CT2: what is told of pins later takes the place of what was told before", () => {
  const comments = new Comments();
  comments.place([pin(1, "standing"), pin(2, "standing")]);
  comments.place([pin(2, "detached")]);
  expect([...comments.pins.value.values()].map(({ thread, state }) => [thread, state])).toEqual([
    [1, "standing"],
    [2, "detached"],
  ]);
});

it("CT3: threads that have changed are kept until somebody reads them, and another session forgets all", () => {
  const comments = new Comments();
  comments.place([pin(1, "standing")]);
  comments.change([1, 2]);
  comments.change([2, 3]);
  expect([...comments.stale.value]).toEqual([1, 2, 3]);
  comments.open.value = 1;
  const clear = vi.fn();
  comments.conversation.value = { clear } as unknown as Conversation;
  comments.clear();
  expect([comments.pins.value.size, comments.stale.value.size, comments.open.value]).toEqual([0, 0, null]);
  expect(clear).toHaveBeenCalledTimes(1);
});
