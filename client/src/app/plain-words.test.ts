import { describe, expect, it } from "vitest";
import { plainly } from "./plain-words";

describe("plain words", () => {
  it("say that a branch is gone", () => {
    const problem = { code: "not_found", field: "row", message: "there is no living metamer with row 152" } as const;
    const turn = { kind: "turn_branch", row: 152, rotation: [0, 0, 0, 1] } as const;
    expect(plainly(problem, { ...turn, rotation: [0, 0, 0, 1] })).toMatch(/^That branch is gone/);
  });

  it("name no rows, and are a sentence", () => {
    const problem = { code: "refused", message: "row 7 is the foot of a trunk, which cannot be turned" } as const;
    expect(plainly(problem)).toBe("That branch is the foot of a trunk, which cannot be turned.");
  });

  it("leave sentences as they are", () => {
    expect(plainly({ code: "refused", message: "There is nothing to undo." })).toBe("There is nothing to undo.");
  });
});
