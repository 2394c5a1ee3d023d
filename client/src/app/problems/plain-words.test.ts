import { afterEach, describe, expect, it } from "vitest";
import { RequestFailed, turnedAway } from "../requests/request";
import { language } from "../words/say";
import { noticed, plainly, sentence } from "./plain-words";

afterEach(() => {
  language.value = "en";
});

describe("plain words", () => {
  it("are those of the reason, whatever the sentence says", () => {
    const problem = { code: "not_found", reason: "branch-gone", field: "rows[3]", message: "no row 152" } as const;
    expect(plainly(problem)).toMatch(/^That branch is gone/);
    language.value = "de";
    expect(plainly({ code: "refused", reason: "nothing-to-undo", message: "x" })).toMatch(/rückgängig/);
  });

  it("tell what is allowed", () => {
    language.value = "de";
    const full = { code: "refused", reason: "obstacles-full", allowed: "up to 64 obstacles", message: "x" } as const;
    expect(plainly(full)).toMatch(/64 Hindernisse/);
    const long = { code: "out_of_range", reason: "text-length", allowed: "1 to 80 characters", message: "x" } as const;
    expect(plainly(long)).toMatch(/1 bis 80 Zeichen/);
    const large = { code: "too_many", reason: "large-file", allowed: "64 MiB", message: "x" } as const;
    expect(plainly(large)).toBe("Die Datei ist größer als 64 MiB.");
  });

  it("tell a range in the language of the page, and nothing of what is no range", () => {
    const message = "radius is -50.5; allowed: -4.5 to 40";
    const problem = { code: "out_of_range", reason: "out-of-range", allowed: "-4.5 to 40", message } as const;
    expect(plainly(problem)).toBe("Radius is -50.5; allowed: -4.5 to 40.");
    language.value = "de";
    expect(plainly(problem)).toMatch(/-4.5 bis 40/);
    expect(plainly({ ...problem, allowed: "a row, 40 metamers up at most" })).toBe("Dieser Wert ist nicht möglich.");
  });

  it("are better ones for a field that has such", () => {
    const problem = { code: "too_many", reason: "too-many", message: "x" } as const;
    expect(plainly({ ...problem, field: "outline" })).toMatch(/^This outline/);
    expect(plainly({ ...problem, field: "samples" })).toMatch(/^That is too much/);
  });

  it("AC22, AC18, AC17: say what of a gift or of governing is not one's own to do", () => {
    const problem = { code: "refused", reason: "forbidden", message: "x" } as const;
    for (const spoken of ["en", "de"] as const) {
      language.value = spoken;
      const plain = plainly(problem);
      const fields = ["role", "name", "member", "person", "session", "collection"];
      const said = fields.map((field) => plainly({ ...problem, field }));
      expect(new Set([plain, ...said]).size, spoken).toBe(fields.length + 1);
    }
    language.value = "en";
    expect(plainly({ ...problem, field: "name" })).toMatch(/^Not with yourself/);
  });

  it("say what is wrong with a file", () => {
    const problem = {
      code: "malformed",
      reason: "gltf-needs",
      cause: "KHR_draco_mesh_compression",
      message: "x",
    } as const;
    expect(plainly(problem)).toMatch(/needs KHR_draco_mesh_compression/);
  });

  it("are the server's own for a reason that the page does not know, without rows", () => {
    language.value = "de";
    const problem = { code: "refused", reason: "full-moon" as never, message: "row 7 is under a full moon" } as const;
    expect(plainly(problem)).toBe("That branch is under a full moon.");
    expect(plainly({ code: "unavailable", message: "Es ist still." })).toBe("Es ist still.");
  });

  it("are found for requests, closed sockets and errors", () => {
    const problem = { code: "refused", reason: "nothing-to-redo", message: "x" } as const;
    expect(sentence(new RequestFailed(409, problem))).toBe("There is nothing to redo.");
    expect(sentence(turnedAway("session-damaged: The session is damaged: 7."))).toMatch(/^The record of this tree/);
    expect(sentence(turnedAway("come again"))).toBe("Come again.");
    expect(sentence(new Error("It broke."))).toBe("It broke.");
  });

  it("OP4: a notice of damage names the entry from which on the record is missing", () => {
    for (const spoken of ["en", "de"] as const) {
      language.value = spoken;
      expect(noticed({ kind: "damaged", entry: 152 })).toMatch(/152/);
      expect(noticed({ kind: "regrown", from: 3, to: 4 })).not.toMatch(/[{}]/);
    }
  });
});
