import { describe, expect, it } from "vitest";
import { RequestFailed } from "../requests/request";
import { language } from "../words/say";
import { noticed, plainly, sentence } from "./plain-words";

describe("plain words", () => {
  it("say that a branch is gone", () => {
    for (const field of ["row", "rows[3]", "onto", "base", "touches[0]"]) {
      const message = "there is no living metamer with row 152";
      expect(plainly({ code: "not_found", field, message })).toMatch(/^That branch is gone/);
    }
    expect(plainly({ code: "not_found", field: "future", message: "there is no future 4" })).toMatch(/future/);
  });

  it("name no rows, and are a sentence", () => {
    const problem = { code: "refused", message: "row 7 is the foot of a trunk, which cannot be turned" } as const;
    expect(plainly(problem)).toBe("That branch is the foot of a trunk, which cannot be turned.");
  });

  it("known sentences are shown in the language of the page", () => {
    language.value = "de";
    try {
      expect(plainly({ code: "refused", message: "there is nothing to undo" })).toMatch(/rückgängig/);
      const many = "the scene has 64 obstacles; remove one first";
      expect(plainly({ code: "refused", message: many })).toMatch(/64 Hindernisse/);
      expect(plainly({ code: "out_of_range", allowed: "0 to 40", message: "radius is 50" })).toMatch(/0 bis 40/);
      expect(plainly({ code: "refused", message: "the moon is full" })).toBe("The moon is full.");
    } finally {
      language.value = "en";
    }
  });

  it("what a request came to is shown like any other problem", () => {
    const failed = new RequestFailed(409, { code: "refused", message: "there is nothing to redo" });
    language.value = "de";
    try {
      expect(sentence(failed)).toMatch(/wiederholen/);
    } finally {
      language.value = "en";
    }
    expect(sentence(new Error("It broke."))).toBe("It broke.");
  });

  it("leave sentences as they are", () => {
    expect(plainly({ code: "refused", message: "There is nothing to undo." })).toBe("There is nothing to undo.");
  });

  it("OP4: a notice of damage names the entry from which on the record is missing", () => {
    for (const spoken of ["en", "de"] as const) {
      language.value = spoken;
      expect(noticed({ kind: "damaged", entry: 152 })).toMatch(/152/);
      expect(noticed({ kind: "regrown", from: 3, to: 4 })).not.toMatch(/[{}]/);
    }
    language.value = "en";
  });
});
