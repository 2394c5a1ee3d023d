import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { SHIPPED } from "../document/grammar/grammar-names";
import { kindText } from "./grammar-problems";
import { SHIPPED_GRAMMARS } from "./grammars";

describe("the words of grammars", () => {
  it("name every grammar that ships in German", () => {
    expect(Object.keys(SHIPPED_GRAMMARS).sort()).toEqual([...SHIPPED].sort());
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
