import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { SHIPPED } from "../document/grammar/grammar-names";
import { GERMAN } from "./grammar-german";
import { kindText, sentenceOf } from "./grammar-problems";
import { SENTENCES } from "./grammar-sentences";
import { SHIPPED_GRAMMARS } from "./grammars";
import { language } from "./say";

describe("the words of grammars", () => {
  it("name every grammar that ships in German", () => {
    expect(Object.keys(SHIPPED_GRAMMARS).sort()).toEqual([...SHIPPED].sort());
  });

  it("say in German all that the server can say, with the same values", () => {
    const holes = (text: string | null | undefined) => (text?.match(/\{\w+\}/g) ?? []).sort();
    for (const [id, [message, hint]] of Object.entries(SENTENCES)) {
      const german: readonly string[] = GERMAN[id as keyof typeof GERMAN];
      expect(holes(german[0]), id).toEqual(holes(message));
      expect(holes(german[1]), id).toEqual(holes(hint));
      expect(german.length === 2, id).toBe(hint !== null);
      expect(german[0]?.endsWith("."), id).toBe(false);
    }
  });

  it("are told by name and values, not by the server's sentence", () => {
    const told = {
      id: "unknown-function.near",
      values: { name: "sni", near: "sin" },
      message: "there is no function `sni`",
      hint: "did you mean sin?",
    };
    expect(sentenceOf(told)).toEqual({ message: told.message, hint: told.hint });
    language.value = "de";
    expect(sentenceOf(told)).toEqual({ message: "eine Funktion `sni` gibt es nicht", hint: "meinst du sin?" });
    // One that a newer server says stays in its words.
    expect(sentenceOf({ ...told, id: "of-tomorrow" }).message).toBe(told.message);
    language.value = "en";
  });

  it("know every kind of problem that is documented", () => {
    const page = readFileSync(new URL("../../../../docs/grammars.md", import.meta.url), "utf8");
    const table = page.split("## Errors")[1]?.split("## ")[0] ?? "";
    const codes = table
      .split("\n")
      .filter((line) => line.startsWith("| `"))
      .flatMap((line) => [...(line.split("|")[1] ?? "").matchAll(/`([a-z-]+)`/g)].map(([, code]) => code ?? ""));
    expect(codes.length).toBeGreaterThan(30);
    expect(codes.filter((code) => kindText(code) === code && !["c", "python"].includes(code))).toEqual([]);
  });
});
