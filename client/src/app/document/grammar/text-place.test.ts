import { describe, expect, it } from "vitest";
import { tokens } from "./grammar-tokens";
import { carriedCaret, lineAndColumn, pieces, placeAt, problemAt, rangeOf, ruleRange } from "./text-place";

const problem = (line: number, column: number, length: number) => ({ line, column, length });

describe("places in a text", () => {
  const text = "aé𝔸b\n\ncd";

  it("count characters, as the server does", () => {
    expect([placeAt(text, 1, 1), placeAt(text, 1, 4), placeAt(text, 2, 1), placeAt(text, 3, 2)]).toEqual([0, 4, 6, 8]);
    expect(lineAndColumn(text, 4)).toEqual({ line: 1, column: 4 });
    expect(lineAndColumn(text, 8)).toEqual({ line: 3, column: 2 });
  });

  it("stay within the text whatever is said", () => {
    expect([placeAt(text, 1, 99), placeAt(text, 2, 9), placeAt(text, 77, 1)]).toEqual([5, 6, 9]);
  });
});

describe("problems", () => {
  it("are shown where something is missing as well", () => {
    expect(rangeOf("A --> F[", problem(1, 8, 1))).toEqual({ from: 7, to: 8 });
    expect(rangeOf("A --> F(", problem(1, 9, 0))).toEqual({ from: 7, to: 8 });
    expect(rangeOf("", problem(1, 1, 0))).toEqual({ from: 0, to: 0 });
    expect(rangeOf("ab\ncd", problem(2, 1, 0))).toEqual({ from: 3, to: 4 });
  });

  it("are found by a caret in them, before those it stands beside", () => {
    const ranges = [
      { from: 2, to: 4 },
      { from: 4, to: 6 },
    ];
    expect([1, 2, 4, 6, 7].map((caret) => problemAt(ranges, caret))).toEqual([null, 0, 1, 1, null]);
  });

  it("cut the pieces that they begin or end in", () => {
    const text = "title: hello";
    const cut = pieces(tokens(text), [{ from: 9, to: 11 }]);
    expect(cut.map(({ from, to, problem }) => [text.slice(from, to), problem])).toEqual([
      ["title:", undefined],
      [" ", undefined],
      ["he", undefined],
      ["ll", 0],
      ["o", undefined],
    ]);
  });
});

describe("rules", () => {
  it("go on over indented lines", () => {
    const text = "A --> F\n  [+A]\n  B\nC --> D\n  x = 3";
    expect(text.slice(...Object.values(ruleRange(text, 1)))).toBe("A --> F\n  [+A]\n  B");
    expect(text.slice(...Object.values(ruleRange(text, 4)))).toBe("C --> D");
  });
});

describe("a caret in a text that somebody else changes", () => {
  it("stays with what it stood at", () => {
    expect(carriedCaret("abc def", "abc xyz def", 2)).toBe(2);
    expect(carriedCaret("abc def", "abc xyz def", 6)).toBe(10);
    expect(carriedCaret("abc def", "", 4)).toBe(0);
    expect(carriedCaret("abcdef", "abXdef", 3)).toBe(3);
  });
});
