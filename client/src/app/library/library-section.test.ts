import { describe, expect, it } from "vitest";
import { savedTree } from "../../../test/saved-tree";
import type { SectionName } from "../page/layout";
import type { ToastAction } from "../page/toasts";
import { LibrarySection } from "./library-section";
import { ANYTHING, type Wanted } from "./wanted";

/** A section of three trees, what it asks of the server, and what it says. */
async function section(name: SectionName = "trees", wanted: Wanted = ANYTHING) {
  const all = ["a", "b", "c"].map((id) => savedTree({ id, name: id.toUpperCase() }));
  const asked: string[] = [];
  const said: { readonly text: string; readonly action: ToastAction | undefined }[] = [];
  const server = { failsAt: "", between: () => {} };
  const answer = (what: string, id: string) => {
    asked.push(`${what} ${id}`);
    server.between();
    if (server.failsAt === id) throw new Error("The disk is full.");
    return all.find((tree) => tree.id === id)!;
  };
  const section = new LibrarySection({
    name,
    species: () => [],
    api: {
      listTrees: async () => ({ items: all }),
      changeTree: async (id, change) => ({ ...answer("change", id), ...change }),
      copyTree: async (id, { name }) => ({ ...answer("copy", id), id: `${id}2`, name }),
      deleteTree: async (id) => void answer("delete", id),
      deleteTreeForGood: async (id) => void answer("for good", id),
      undeleteTree: async (id) => answer("undelete", id),
      setFavourite: async (id, favourite) => void answer(favourite ? "star" : "unstar", id),
    },
    wanted: () => wanted,
    said: () => ({ author: "Ann" }),
    show: (text, action) => void said.push({ text, action }),
  });
  await section.pages.next();
  return { section, all, asked, said, server, ids: () => section.pages.items.value?.map(({ id }) => id) };
}

describe("a section", () => {
  it("deletes what is chosen, says so, and takes it back", async () => {
    const { section: here, asked, said, ids } = await section();
    here.toggle("a");
    here.toggle("b");
    here.toggle("c");
    here.toggle("b");
    await here.remove(here.chosenTrees);
    expect([ids(), here.chosen.value, said[0]?.text]).toEqual([["b"], null, "2 trees are deleted"]);
    said[0]?.action?.act();
    await expect.poll(ids).toEqual(["c", "a", "b"]);
    expect(asked).toEqual(["delete a", "delete c", "undelete a", "undelete c"]);
  });

  it("says how far it is, and stops at once", async () => {
    const { section: here, all, said, server, ids } = await section();
    const seen: unknown[] = [];
    server.between = () => {
      seen.push(here.work.progress.peek());
      if (seen.length === 2) here.work.cancel();
    };
    await here.remove(all);
    expect(seen).toEqual([
      { bytes: 0, total: 3 },
      { bytes: 1, total: 3 },
    ]);
    expect([ids(), said[0]?.text], "what is done can be taken back").toEqual([["c"], "2 trees are deleted"]);
  });

  it("what fails is named, and so is what was done before", async () => {
    const { section: here, all, said, server, ids } = await section();
    server.failsAt = "b";
    await here.remove(all);
    expect([ids(), said.map(({ text }) => text)]).toEqual([
      ["b", "c"],
      ["The disk is full.", "“A” is deleted"],
    ]);
  });

  it("does one thing at a time, and says so", async () => {
    const { section: here, all, said, asked } = await section();
    await Promise.all([here.duplicate(all), here.remove(all)]);
    expect(asked).toEqual(["copy a", "copy b", "copy c"]);
    expect(said[0]?.text).toBe("Wait until the work on other trees is done.");
  });

  it("a template moves to the other section, and back", async () => {
    const { section: here, all, said, ids } = await section();
    await here.mark(all.slice(0, 1), true);
    expect(ids()).toEqual(["b", "c"]);
    said[0]?.action?.act();
    await expect.poll(ids).toEqual(["a", "b", "c"]);
  });

  it("a copy stands first; a name has no more letters than fit", async () => {
    const { section: here, all } = await section();
    const long = "x".repeat(79);
    await here.duplicate([all[1]!, { ...all[0]!, name: long }]);
    expect(here.pages.items.value?.slice(0, 2).map(({ name }) => name)).toEqual([long, "B (copy)"]);
  });

  it("a tree becomes a favourite, and is none again", async () => {
    const { section: here, asked } = await section();
    const first = () => here.pages.items.value![0]!;
    await here.star(first());
    expect(first().favourite).toBe(true);
    await here.star(first());
    expect([first().favourite, asked]).toEqual([false, ["star a", "unstar a"]]);
  });

  it("trees are moved to a collection, but for those that lie there, and back", async () => {
    const { section: here, all, asked, said, ids } = await section("trees", { ...ANYTHING, collection: "" });
    const wood = { id: "wood", name: "Wood" };
    await here.move([all[0]!, { ...all[1]!, collection: "wood" }], wood);
    expect([ids(), said[0]?.text, asked]).toEqual([["b", "c"], "“A” lies in “Wood” now", ["change a"]]);
    said[0]?.action?.act();
    await expect.poll(ids).toEqual(["a", "b", "c"]);
    await here.move(all, null);
    expect([said[1]?.text, asked.length]).toEqual(["That lies in no collection.", 2]);
  });

  it("trees that are moved stay where all are listed", async () => {
    const { section: here, all, said, ids } = await section();
    await here.move(all.slice(0, 2), { id: "wood", name: "Wood" });
    expect([ids(), said[0]?.text]).toEqual([["a", "b", "c"], "2 trees lie in “Wood” now"]);
    expect(here.pages.items.value?.[0]?.collection).toBe("wood");
  });

  it("what is deleted for good leaves the section of deleted trees", async () => {
    const { section: here, all, asked, said, ids } = await section("deleted");
    await here.removeForGood(all[0]!);
    expect([ids(), asked, said.map(({ text }) => text)]).toEqual([
      ["b", "c"],
      ["for good a"],
      ["“A” is gone for good"],
    ]);
    expect(said[0]?.action).toBeUndefined();
  });

  it("what is taken back leaves the section of deleted trees", async () => {
    const { section: here, all, said, ids } = await section("deleted");
    await here.takeBack(all.slice(1));
    expect([ids(), said[0]?.text]).toEqual([["a"], "2 trees are back in the library"]);
  });
});
