import { describe, expect, it } from "vitest";
import type { SavedTree } from "../../wire/generated";
import { LibraryPages, PAGE } from "./library-pages";

const tree = (number: number): SavedTree => ({
  id: `t${number}`,
  name: `Tree ${number}`,
  note: "",
  version: 1,
  metamers: 5,
  saved_at: "2026-01-01T00:00:00Z",
  created_at: "2026-01-01T00:00:00Z",
  template: false,
  people: 0,
  revision: 1,
});

/** A library of so many trees, and what was asked of it. */
function library(count: number) {
  const all = Array.from({ length: count }, (_, i) => tree(i));
  const asked: (string | undefined)[] = [];
  const pages = new LibraryPages(async (limit, after) => {
    asked.push(after);
    const from = after === undefined ? 0 : all.findIndex(({ id }) => id === after) + 1;
    const trees = all.slice(from, from + limit);
    const next = trees.length === limit ? trees.at(-1)?.id : undefined;
    return next === undefined ? { trees } : { trees, next };
  });
  return { pages, asked, ids: () => pages.trees.value?.map(({ id }) => id) };
}

describe("library", () => {
  it("comes page by page, each tree once", async () => {
    const { pages, asked, ids } = library(PAGE + 3);
    expect(pages.trees.value).toBeNull();
    await Promise.all([pages.next(), pages.next()]);
    expect([ids()?.length, pages.more.value]).toEqual([PAGE, true]);
    await pages.next();
    await pages.next();
    expect(asked).toEqual([undefined, `t${PAGE - 1}`]);
    expect(new Set(ids()).size).toBe(PAGE + 3);
    expect(pages.more.value).toBe(false);
  });

  it("goes on where it was, though the last tree is gone", async () => {
    const { pages, asked, ids } = library(PAGE + 1);
    await pages.next();
    pages.replace(`t${PAGE - 1}`, null);
    pages.replace("t0", { ...tree(0), name: "Oak" });
    await pages.next();
    expect(asked[1]).toBe(`t${PAGE - 1}`);
    expect(pages.trees.value?.[0]?.name).toBe("Oak");
    expect(ids()?.at(-1)).toBe(`t${PAGE}`);
  });

  it("can be asked again after a failure", async () => {
    let fails = true;
    const pages = new LibraryPages(async () => {
      if (fails) throw new Error("no answer");
      return { trees: [tree(1)] };
    });
    await pages.next();
    expect([pages.trees.value, pages.failure.value]).toEqual([null, new Error("no answer")]);
    fails = false;
    await pages.next();
    expect([pages.trees.value?.length, pages.failure.value, pages.more.value]).toEqual([1, null, false]);
  });
});
