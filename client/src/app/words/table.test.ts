import { describe, expect, it } from "vitest";
import { LANGUAGES } from "./say";
import { TABLE } from "./table";

const entries = Object.entries(TABLE) as [string, readonly string[]][];
const areas = import.meta.glob<Record<string, Record<string, readonly string[]>>>(
  ["./*.ts", "!./*.test.ts", "!./first.ts", "!./later.ts"],
  {
    eager: true,
  },
);

/** The areas' own tables: what has keys with dots. */
function parts(): Record<string, readonly string[]>[] {
  return Object.values(areas).flatMap((exports) =>
    Object.values(exports).filter(
      (part) => part !== TABLE && typeof part === "object" && Object.keys(part).every((key) => key.includes(".")),
    ),
  );
}

const holes = (text: string) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name).sort();

describe("words", () => {
  it("every key has a text in every language", () => {
    expect(entries.length).toBeGreaterThan(200);
    const lacking = entries.filter(
      ([, texts]) => texts.length !== LANGUAGES.length || texts.some((text) => text.trim() === ""),
    );
    expect(lacking).toEqual([]);
  });

  it("have the same holes in every language", () => {
    const uneven = entries.filter(([, [english = "", ...others]]) =>
      others.some((other) => holes(other).join() !== holes(english).join()),
    );
    expect(uneven).toEqual([]);
  });

  it("no area takes another's key, none is left out", () => {
    const keys = parts().flatMap((part) => Object.keys(part));
    expect(keys.length).toBe(new Set(keys).size);
    expect([...keys].sort()).toEqual(entries.map(([key]) => key).sort());
  });

  it("signs are those of print", () => {
    const typewritten = entries.filter(([, texts]) => texts.some((text) => /\.\.\.|\s$|^\s| {2}/.test(text)));
    expect(typewritten).toEqual([]);
  });
});
