import { describe, expect, it } from "vitest";
import { fileName } from "./file-name";

describe("a file's name", () => {
  it("is the tree's, without what systems forbid", () => {
    expect(fileName("Old oak, Tübingen", "png")).toBe("Old oak, Tübingen.png");
    expect(fileName(' ../a\\b: "c" <d>|?*\n', "glb")).toBe("a b c d.glb");
    expect(fileName(" .. ", "json")).toBe("tree.json");
  });
});
