import { describe, expect, it } from "vitest";
import { plainly } from "./plain-words";

describe("plain words", () => {
  it("say that a branch is gone", () => {
    for (const field of ["row", "rows[3]", "onto", "base", "touches[0]"]) {
      const message = "there is no living metamer with row 152";
      expect(plainly({ code: "not_found", field, message })).toMatch(/^That branch is gone/);
    }
    expect(plainly({ code: "not_found", field: "future", message: "There is no such future." })).toMatch(/future/);
  });

  it("name no rows, and are a sentence", () => {
    const problem = { code: "refused", message: "row 7 is the foot of a trunk, which cannot be turned" } as const;
    expect(plainly(problem)).toBe("That branch is the foot of a trunk, which cannot be turned.");
  });

  it("leave sentences as they are", () => {
    expect(plainly({ code: "refused", message: "There is nothing to undo." })).toBe("There is nothing to undo.");
  });
});
