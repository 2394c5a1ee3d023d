import { describe, expect, it } from "vitest";
import { coveredBy } from "./screen-keyboard";

describe("a keyboard on the screen", () => {
  const page = { innerHeight: 800 };

  it("covers the foot of the page", () => {
    expect(coveredBy(page, { height: 480, offsetTop: 0, scale: 1 })).toBe(320);
    expect(coveredBy(page, { height: 480, offsetTop: 40, scale: 1 })).toBe(280);
  });

  it("is not a bar of the browser's, nor a page that is looked at from near", () => {
    expect(coveredBy(page, { height: 740, offsetTop: 0, scale: 1 })).toBe(0);
    expect(coveredBy(page, { height: 400, offsetTop: 100, scale: 2 })).toBe(0);
  });
});
