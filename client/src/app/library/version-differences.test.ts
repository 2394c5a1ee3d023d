import { describe, expect, it } from "vitest";
import type { TreeVersion } from "../../wire/generated";
import { language } from "../words/say";
import { differencesOf, type Seen } from "./version-differences";

const version: TreeVersion = {
  number: 1,
  saved_at: "2026-03-01T10:00:00Z",
  author: "Ada",
  note: "",
  metamers: 1200,
  thumbnail: "",
  document: "",
};
const shape = { min: [-1, -0.2, -1.5], max: [1, 4, 1.5] } as const;
const seen: Seen = { version, shape, species: "Oak" };

describe("what differs between two versions", () => {
  it("is nothing where all is the same", () => {
    expect(differencesOf(seen, { ...seen, version: { ...version, number: 2 } })).toEqual([]);
  });

  it("is named with both values, and nothing else is", () => {
    const newer: Seen = {
      version: { ...version, metamers: 3400, note: "Taller", author: "Ben" },
      shape: { ...shape, max: [1, 5.5, 1.5] },
      species: "Pine",
    };
    expect(differencesOf(seen, newer)).toEqual([
      { label: "library.differ.metamers", older: "1,200", newer: "3,400" },
      { label: "library.differ.height", older: "4 m", newer: "5.5 m" },
      { label: "library.differ.species", older: "Oak", newer: "Pine" },
      { label: "library.differ.author", older: "Ada", newer: "Ben" },
      { label: "library.differ.note", older: "none", newer: "Taller" },
    ]);
  });

  it("says nothing of a size that is not known of both", () => {
    const larger = { ...shape, max: [2, 9, 2] } as const;
    expect(differencesOf({ ...seen, shape: null }, { ...seen, shape: larger })).toEqual([]);
  });

  it("speaks German", () => {
    language.value = "de";
    const newer = { ...seen, version: { ...version, metamers: 3400 } };
    expect(differencesOf(seen, newer)[0]).toMatchObject({ older: "1.200", newer: "3.400" });
    language.value = "en";
  });
});
