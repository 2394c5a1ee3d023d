import { signal } from "@preact/signals";
import { expect, it } from "vitest";
import { areUnsavedTrees, isSavedState, type SavedState, type UnsavedTree } from "./unsaved-tree";
import { UnsavedTrees } from "./unsaved-trees";

function page() {
  const [list, saved] = [signal<readonly UnsavedTree[]>([]), signal<SavedState | null>(null)];
  const here = { session: "oak" as string | null, metamers: 0 };
  let picture: () => Promise<string | undefined> = async () => "data:image/webp;base64,";
  const trees = new UnsavedTrees({
    list,
    saved,
    session: () => here.session,
    metamers: () => here.metamers,
    picture: () => picture(),
  });
  const at = (step: number) => trees.follow({ step, done: 1, operations: [{}] });
  const blind = () => {
    picture = () => Promise.reject(new Error("no picture"));
  };
  return { trees, list, saved, here, at, blind };
}

it("a tree is unsaved once something has grown, until it is saved as it stands", () => {
  const { trees, here, at } = page();
  at(0);
  expect(trees.isUnsaved, "a seed is nothing to save").toBe(false);
  here.metamers = 12;
  at(3);
  expect(trees.isUnsaved).toBe(true);
  trees.saved();
  at(3);
  expect(trees.isUnsaved).toBe(false);
  at(4);
  expect(trees.isUnsaved).toBe(true);
  at(3);
  expect(trees.isUnsaved, "what came after may have been something else").toBe(true);
});

it("a tree from the library is saved as it comes", () => {
  const { trees, here, at } = page();
  Object.assign(here, { session: "ash", metamers: 900 });
  trees.clear();
  trees.opened("ash");
  at(70);
  expect(trees.isUnsaved).toBe(false);
  at(71);
  expect(trees.isUnsaved).toBe(true);
});

it("what is left is listed once, the last first, with or without its picture", async () => {
  const { trees, list, here, at, blind } = page();
  here.metamers = 12;
  at(3);
  expect(await trees.keep()).toBe(true);
  Object.assign(here, { session: "ash", metamers: 5 });
  blind();
  await trees.keep();
  Object.assign(here, { session: "oak", metamers: 20 });
  await trees.keep();
  expect(list.value.map(({ session, metamers }) => [session, metamers])).toEqual([
    ["oak", 20],
    ["ash", 5],
  ]);
  expect(areUnsavedTrees(JSON.parse(JSON.stringify(list.value)))).toBe(true);
  trees.saved();
  expect(await trees.keep(), "it is in the library").toBe(false);
  expect(list.value.map(({ session }) => session)).toEqual(["ash"]);
});

it("what something else has put into the store is not taken", () => {
  expect([null, {}, [{}], [{ session: 1 }]].map(areUnsavedTrees)).toEqual([false, false, false, false]);
  expect([{}, { session: "oak" }, "oak"].map(isSavedState)).toEqual([false, false, false]);
});
