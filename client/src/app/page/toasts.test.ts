import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { Toasts } from "./toasts";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const texts = (toasts: Toasts) => toasts.list.value.map(({ text }) => text);

it("notes go by themselves, one that offers something later", () => {
  const toasts = new Toasts();
  const act = vi.fn();
  toasts.show("told");
  toasts.show("offered", { label: "Undo", act });
  vi.advanceTimersByTime(5000);
  expect(texts(toasts)).toEqual(["offered"]);
  toasts.list.value[0]?.action?.act();
  expect(act).toHaveBeenCalledOnce();
  vi.advanceTimersByTime(6000);
  expect(texts(toasts)).toEqual([]);
});

it("the same note twice is one, and the newest three are shown", () => {
  const toasts = new Toasts();
  for (const text of ["a", "b", "a", "c", "d"]) toasts.show(text);
  expect(texts(toasts)).toEqual(["a", "c", "d"]);
});

it("a note goes as soon as what it says is known, and no other", () => {
  const toasts = new Toasts();
  toasts.show("Ann has said something", { label: "Read", act: () => {} });
  toasts.show("told");
  toasts.withdraw("Ann has said something");
  expect(texts(toasts)).toEqual(["told"]);
});
