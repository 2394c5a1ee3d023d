import { describe, expect, it } from "vitest";
import type { TreeCollection } from "../../wire/generated";
import { Catalogue, inOrder, pathOf, placesFor } from "./catalogue";

const collection = (id: string, parent?: string): TreeCollection => ({
  id,
  name: id.toUpperCase(),
  trees: 0,
  ...(parent === undefined ? {} : { parent }),
});

const all = [
  collection("copse", "wood"),
  collection("garden"),
  collection("grove", "copse"),
  collection("lost", "gone"),
  collection("pond", "wood"),
  collection("wood"),
];

describe("collections", () => {
  it("stand before those that lie in them, each once, also where one is missing", () => {
    const folders = inOrder(all);
    expect(folders.map(({ id, depth }) => `${depth} ${id}`)).toEqual([
      "0 garden",
      "0 lost",
      "0 wood",
      "1 copse",
      "2 grove",
      "1 pond",
    ]);
    expect(pathOf(folders[4]!)).toBe("WOOD › COPSE › GROVE");
  });

  it("are never moved into themselves", () => {
    const places = (id: string) => placesFor(inOrder(all), id).map((folder) => folder.id);
    expect(places("wood")).toEqual(["garden", "lost"]);
    expect(places("copse")).toEqual(["garden", "lost", "wood", "pond"]);
    expect(places("pond")).toEqual(["garden", "lost", "wood", "copse", "grove"]);
  });
});

describe("the catalogue", () => {
  it("is asked for anew after a change, and tells what fails", async () => {
    const kept = [...all];
    const said: string[] = [];
    const catalogue = new Catalogue({
      api: {
        listCollections: async () => [...kept],
        listTags: async () => [{ tag: "old", trees: 1 }],
        listAuthors: async () => [],
        addCollection: async ({ name }) => {
          kept.push(collection(name));
          return kept.at(-1)!;
        },
        changeCollection: async () => {
          throw new Error("The disk is full.");
        },
        deleteCollection: async (id) =>
          void kept.splice(
            kept.findIndex((one) => one.id === id),
            1,
          ),
      },
      show: (text) => void said.push(text),
    });
    expect(catalogue.folders.value).toBeNull();
    expect((await catalogue.add("new"))?.name).toBe("NEW");
    expect([catalogue.folder("new")?.depth, catalogue.tags.value.length]).toEqual([0, 1]);
    expect([await catalogue.remove("new"), catalogue.folder("new")]).toEqual([true, undefined]);
    await catalogue.rename("wood", "Forest");
    expect([said, catalogue.folder("wood")?.name]).toEqual([["The disk is full."], "WOOD"]);
  });
});
