import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { type TokenKind, tokens } from "./grammar-tokens";

/** The pieces of a text that are something, as `kind:piece`. */
const said = (text: string) =>
  tokens(text)
    .map(({ from, to, kind }) => [kind, text.slice(from, to)] as const)
    .filter(([kind, piece]) => kind !== "plain" || piece.trim() !== "")
    .map(([kind, piece]) => `${kind}:${piece}`);

const kindOf = (text: string, piece: string, nth = 0): TokenKind | undefined => {
  let at = -1;
  for (let i = 0; i <= nth; i += 1) {
    at = text.indexOf(piece, at + 1);
  }
  return tokens(text).find(({ from, to }) => from <= at && at < to)?.kind;
};

/** Where every piece begins where the one before ends. */
const hasGaps = (text: string) => {
  let at = 0;
  for (const { from, to } of tokens(text)) {
    if (from !== at || to <= from) return true;
    at = to;
  }
  return at !== text.length;
};

describe("the pieces of a grammar", () => {
  it("tell modules that are rewritten from what the turtle draws", () => {
    expect(said("A(l) --> !(w)F(l)[+(30)A(l*0.8)]Q")).toEqual([
      ...["rewritten:A", "operator:(", "name:l", "operator:)", "arrow:-->", "width:!", "operator:(", "name:w"],
      ...["operator:)", "draw:F", "operator:(", "name:l", "operator:)", "branch:[", "turn:+", "operator:("],
      ...["number:30", "operator:)", "rewritten:A", "operator:(", "name:l", "operator:*", "number:0.8", "operator:)"],
      ...["branch:]", "module:Q"],
    ]);
  });

  it("know contexts, conditions and probabilities", () => {
    const text = "A < B(x) > C : x < 3 --> F : 0.5";
    expect(said(text)).toEqual([
      ...["module:A", "operator:<", "rewritten:B", "operator:(", "name:x", "operator:)", "operator:>", "module:C"],
      ...["operator::", "name:x", "operator:<", "number:3", "arrow:-->", "draw:F", "operator::", "number:0.5"],
    ]);
  });

  it("take headers, definitions and titles for what they are", () => {
    expect(said("title: A nice F\nderivation  length: 8\na = sin(30)\naxiom: FA")).toEqual([
      ...["header:title:", "text:A nice F", "header:derivation  length:", "number:8"],
      ...["name:a", "operator:=", "function:sin", "operator:(", "number:30", "operator:)"],
      ...["header:axiom:", "draw:F", "module:A"],
    ]);
  });

  it("read declared names whole, the longest first", () => {
    const text = "module Apex, ApexB(2)\naxiom: ApexBApex\nApex --> F";
    expect(kindOf(text, "ApexBApex")).toBe("module");
    expect(said(text).slice(-5)).toEqual(["module:ApexB", "rewritten:Apex", "rewritten:Apex", "arrow:-->", "draw:F"]);
  });

  it("leave turns that look like comments alone", () => {
    const text = "A --> F//F # end\n// note\n/* a\nb */B --> /////F#(2) // more";
    expect(kindOf(text, "//F")).toBe("turn");
    expect(kindOf(text, "# end")).toBe("comment");
    expect(kindOf(text, "// note")).toBe("comment");
    expect(kindOf(text, "b */")).toBe("comment");
    expect(kindOf(text, "/////F")).toBe("turn");
    expect(kindOf(text, "#(2)")).toBe("width");
    expect(kindOf(text, "// more")).toBe("comment");
  });

  it("go on with an indented line as the one before", () => {
    expect(said("A --> F\n  [+A]")).toContain("branch:[");
    expect(said("define: { a = 1\n  b = sqrt(2) }")).toContain("function:sqrt");
  });

  it("give a bracket the depth of its branch", () => {
    const depths = tokens("A --> [[F]F]F]").flatMap(({ nesting }) => (nesting === undefined ? [] : [nesting]));
    expect(depths).toEqual([1, 2, 2, 1, 0]);
  });

  it("call other languages foreign", () => {
    expect(kindOf("if x > 3:", "if")).toBe("foreign");
    expect(kindOf("for i in range(3): produce F", "for")).toBe("foreign");
  });

  it("cover every text that ships without gaps", () => {
    const folder = new URL("../../../../../server/grammar/grammars/", import.meta.url);
    const files = readdirSync(folder);
    expect(files.length).toBeGreaterThan(20);
    for (const file of files) {
      const text = readFileSync(new URL(file, folder), "utf8");
      expect(hasGaps(text), file).toBe(false);
      expect(
        tokens(text).some(({ kind }) => kind === "foreign"),
        file,
      ).toBe(false);
    }
  });

  it("cover whatever is typed without gaps", () => {
    const signs = [
      "A",
      "F",
      "[",
      "]",
      "(",
      ")",
      "-->",
      "<",
      ">",
      ":",
      "\n",
      " ",
      "  ",
      "/*",
      "*/",
      "//",
      "#",
      "~",
      "@",
      "𝔸",
      "1.5",
      "axiom:",
      "if ",
      "=",
      "nF(",
    ];
    let seed = 7;
    for (let i = 0; i < 400; i += 1) {
      let text = "";
      for (let j = 0; j < 30; j += 1) {
        seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
        text += signs[(seed >>> 8) % signs.length];
      }
      expect(hasGaps(text), JSON.stringify(text)).toBe(false);
    }
  });
});
