import { describe, expect, it } from "vitest";
import { ANYTHING, asked, cleared, conditions, isWanted, SIZES, type Wanted } from "./wanted";

const all: Wanted = {
  words: " oak  lake ",
  tags: ["old", "Red maple"],
  collection: "wood",
  favourite: true,
  species: "silver-birch",
  author: "Ann",
  mine: true,
  size: "medium",
  from: "2026-03-01",
  to: "2026-03-31",
  sort: "name",
};

const named = (query: object) => Object.entries(query).filter(([, value]) => value !== undefined);

describe("what is wanted", () => {
  it("is asked for in the words of the server", () => {
    expect(named(asked(ANYTHING))).toEqual([["sort", "newest"]]);
    expect(asked(all)).toMatchObject({
      q: "oak lake",
      tags: "old,Red maple",
      collection: "wood",
      favourite: true,
      mine: true,
      min_metamers: 1000,
      max_metamers: 9999,
      sort: "name",
    });
    expect(asked({ ...ANYTHING, collection: "" }).collection, "in none").toBe("");
  });

  it("days begin and end at midnight here, also the last of a month", () => {
    const { saved_from: from = "", saved_before: before = "" } = asked(all);
    expect([new Date(from), new Date(before)]).toEqual([new Date(2026, 2, 1), new Date(2026, 3, 1)]);
    expect(from, "as the server compares them").toMatch(/^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$/);
    expect(asked({ ...all, from: "soon", to: "" })).toMatchObject({ saved_from: undefined, saved_before: undefined });
  });

  it("years that are being typed are none that the server refuses", () => {
    expect(asked({ ...all, from: "0202-01-01", to: "20260-01-01" })).toMatchObject({
      saved_from: "1970-01-01T00:00:00.000Z",
      saved_before: "9999-01-01T00:00:00.000Z",
    });
  });

  it("sizes leave no gap", () => {
    const [, ...ranges] = Object.values(SIZES);
    const ends = ranges.slice(0, -1).map(([, most]) => (most ?? 0) + 1);
    expect(ranges.slice(1).map(([least]) => least)).toEqual(ends);
  });

  it("is narrowed by conditions, each of which can be taken out", () => {
    expect(conditions(ANYTHING, String)).toEqual([]);
    let left = all;
    const texts: string[] = [];
    for (let [first] = conditions(left, () => "Birch"); first; [first] = conditions(left, () => "Birch")) {
      texts.push(first.text);
      left = first.without;
    }
    expect(texts.slice(0, 5)).toEqual(["“oak  lake”", "Tag: old", "Tag: Red maple", "Favourites", "Birch"]);
    expect([texts.length, new Set(texts).size]).toEqual([10, 10]);
    expect(left, "the place and the order stay").toEqual(cleared(all));
    expect(cleared(all)).toEqual({ ...ANYTHING, collection: "wood", sort: "name" });
  });

  it("that something else was kept as is none", () => {
    expect([all, ANYTHING].map(isWanted)).toEqual([true, true]);
    for (const other of [
      null,
      3,
      {},
      { ...all, tags: "old" },
      { ...all, sort: "best" },
      { ...all, size: "toString" },
    ]) {
      expect(isWanted(other)).toBe(false);
    }
  });
});
