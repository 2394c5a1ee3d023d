import { afterEach, describe, expect, it } from "vitest";
import { countText, metresText, yearsText } from "./measure-text";
import { language } from "./say";

const plain = (text: string) => text.replaceAll("\u00a0", " ");

describe("measures in words", () => {
  afterEach(() => {
    language.value = "en";
  });

  it("are written as the language of the page writes them", () => {
    const all = () => [metresText(0.356), metresText(12.34), yearsText(1), yearsText(23), countText(12345)].map(plain);
    expect(all()).toEqual(["0.36 m", "12.3 m", "1 year", "23 years", "12,345"]);
    language.value = "de";
    expect(all()).toEqual(["0,36 m", "12,3 m", "1 Jahr", "23 Jahre", "12.345"]);
  });
});
