import { describe, expect, it } from "vitest";
import { savedTree } from "../../../test/saved-tree";
import type { SavedTree } from "../../wire/generated";
import { PAGE, Pages } from "./pages";

const tree = (number: number) => savedTree({ id: `t${number}`, name: `Tree ${number}` });

const idOf = ({ id }: SavedTree) => id;

/** A library of so many trees, and what was asked of it. */
function library(count: number) {
  const all = Array.from({ length: count }, (_, i) => tree(i));
  const asked: (string | undefined)[] = [];
  const pages = new Pages<SavedTree>(async (limit, after) => {
    asked.push(after);
    const from = after === undefined ? 0 : all.findIndex(({ id }) => id === after) + 1;
    const items = all.slice(from, from + limit);
    const next = items.length === limit ? items.at(-1)?.id : undefined;
    return next === undefined ? { items } : { items, next };
  }, idOf);
  return { pages, asked, ids: () => pages.items.value?.map(({ id }) => id) };
}

describe("pages", () => {
  it("comes page by page, each tree once", async () => {
    const { pages, asked, ids } = library(PAGE + 3);
    expect(pages.items.value).toBeNull();
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
    expect(pages.items.value?.[0]?.name).toBe("Oak");
    expect(ids()?.at(-1)).toBe(`t${PAGE}`);
  });

  it("what is new stands first, and is not listed twice", async () => {
    const { pages, ids } = library(2);
    pages.begin(tree(0));
    await pages.next();
    expect(ids()).toEqual(["t0", "t1"]);
  });

  it("can be asked again after a failure", async () => {
    let fails = true;
    const pages = new Pages<SavedTree>(async () => {
      if (fails) throw new Error("no answer");
      return { items: [tree(1)] };
    }, idOf);
    await pages.next();
    expect([pages.items.value, pages.failure.value]).toEqual([null, new Error("no answer")]);
    fails = false;
    await pages.next();
    expect([pages.items.value?.length, pages.failure.value, pages.more.value]).toEqual([1, null, false]);
  });

  it("begins anew without what was there, and without late answers about it", async () => {
    const answers: ((page: { items: readonly SavedTree[] }) => void)[] = [];
    const pages = new Pages<SavedTree>(() => new Promise((answer) => answers.push(answer)), idOf);
    const first = pages.next();
    const second = pages.anew();
    expect([answers.length, pages.asking.value]).toEqual([2, true]);
    answers[0]?.({ items: [tree(1)] });
    await first;
    expect([pages.items.value, pages.asking.value], "nobody wants that any more").toEqual([null, true]);
    answers[1]?.({ items: [tree(2)] });
    await second;
    const third = pages.anew();
    expect(pages.items.value?.map(idOf), "it stays until another list is there").toEqual(["t2"]);
    answers[2]?.({ items: [] });
    await third;
    expect([pages.items.value, pages.asking.value, pages.more.value]).toEqual([[], false, false]);
  });
});
