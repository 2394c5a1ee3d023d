import { describe, expect, it } from "vitest";
import { isReplaced } from "./replaced";

const page = (script: string) => async () => `<html><script type="module" src="${script}"></script></html>`;

describe("another build of the page", () => {
  it("is known by the name of its script", async () => {
    expect(await isReplaced("/assets/index-a.js", page("/assets/index-a.js"))).toBe(false);
    expect(await isReplaced("/assets/index-a.js", page("/assets/index-b.js"))).toBe(true);
  });

  it("is not thought of while the server is silent", async () => {
    expect(await isReplaced("/assets/index-a.js", () => Promise.reject(new Error("offline")))).toBe(false);
  });
});
