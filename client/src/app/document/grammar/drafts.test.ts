import { describe, expect, it } from "vitest";
import { Drafts } from "./drafts";

/** What a browser keeps for its pages. */
function store(): Storage {
  const all = new Map<string, string>();
  return {
    getItem: (key: string) => all.get(key) ?? null,
    setItem: (key: string, value: string) => void all.set(key, value),
  } as Storage;
}

const WRITTEN = { session: "s1", text: "axiom: F[", agreed: "axiom: F" };

describe("texts that no tree has", () => {
  it("keeps the newest first, each once, and nothing of an empty one", () => {
    const drafts = new Drafts(store(), store());
    for (const text of ["a", "b", " \n", "a"]) drafts.keep(text);
    expect(drafts.aside.value).toEqual(["a", "b"]);
    drafts.drop("a");
    expect(drafts.aside.value).toEqual(["b"]);
    for (let i = 0; i < 12; i += 1) drafts.keep(`${i}`);
    expect(drafts.aside.value).toEqual(["11", "10", "9", "8", "7", "6", "5", "4"]);
  });

  it("shares them with other pages of the browser, and none overwrites another's", () => {
    const list = store();
    const [one, other] = [new Drafts(list, store()), new Drafts(list, store())];
    one.keep("of one");
    other.keep("of the other");
    expect(new Drafts(list, store()).aside.value).toEqual(["of the other", "of one"]);
  });

  it("gives what stood in the editor to the page that is loaded again, in the same session alone", () => {
    const own = store();
    new Drafts(store(), own).stands(WRITTEN);
    expect(new Drafts(store(), own).left("s1")).toEqual(WRITTEN);
    const elsewhere = new Drafts(store(), own);
    expect(elsewhere.left("s2")).toBe(null);
    expect(elsewhere.aside.value).toEqual([WRITTEN.text]);
    elsewhere.stands(null);
    expect(new Drafts(store(), own).left("s1")).toBe(null);
  });

  it("goes on where nothing may be stored, or something else stands there", () => {
    const closed = {
      getItem: () => "{",
      setItem: () => {
        throw new Error("full");
      },
    } as unknown as Storage;
    const drafts = new Drafts(closed, closed);
    drafts.keep("a");
    drafts.keep("b");
    expect(drafts.aside.value).toEqual(["b", "a"]);
    expect(drafts.left("s1")).toBe(null);
  });
});
