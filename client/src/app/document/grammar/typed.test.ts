import { describe, expect, it } from "vitest";
import { asMeant, hasChance, nameIn, titleOf } from "./typed";

describe("what devices make of signs", () => {
  it("is written as it was meant, and the caret stays behind it", () => {
    expect(asMeant("A —>", 4)).toEqual({ text: "A -->", caret: 5 });
    expect(asMeant("A →F", 3)).toEqual({ text: "A -->F", caret: 5 });
    expect(asMeant("A --> F—F", 8)).toEqual({ text: "A --> F--F", caret: 9 });
    expect(asMeant("A --> F\nB –> G", 3)).toEqual({ text: "A --> F\nB --> G", caret: 3 });
  });

  it("leaves words alone", () => {
    const text = "title: A tree — small\n// so — and so\nA --> F";
    expect(asMeant(text, 10)).toEqual({ text, caret: 10 });
  });
});

describe("chance", () => {
  it("is in functions and in probabilities on both sides", () => {
    expect(["A --> F : 0.5", "A --> (0.4) FB", "A --> F(ran(2))"].map(hasChance)).toEqual([true, true, true]);
    expect(["A --> F : p", "A --> F(x) : (1-p)/2"].map(hasChance)).toEqual([true, true]);
    const certain = ["A(x) : x > 3 --> F(x)", "derivation length: 8\nA --> F(2)", "A(x) --> F(x > 1 ? 2 : (3))"];
    expect([...certain, "A --> F // so: it is", "A --> F /* a: b */"].filter(hasChance)).toEqual([]);
  });
});

describe("a title", () => {
  it("is what the text says first", () => {
    expect(titleOf("# x\n  Title :  My oak \nlsystem: b")).toBe("My oak");
    expect(titleOf("axiom: F")).toBeNull();
    expect(["Lsystem: 1\naxiom: F", "lsystem: oak\ntitle: My oak", "lsystem: oak"].map(titleOf)).toEqual([
      null,
      "My oak",
      "oak",
    ]);
  });

  it("or else a text is called by its first line", () => {
    expect(["\nLsystem: 1\naxiom: F", "title: My oak\naxiom: F"].map(nameIn)).toEqual(["Lsystem: 1", "My oak"]);
  });
});
