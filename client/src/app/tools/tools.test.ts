import { describe, expect, it } from "vitest";
import { LANGUAGES, type Text } from "../words/say";
import { descriptorOf, FIRST_TOOL, laterOfAll, TOOL_NAMES, toolFor, toolOfKey } from "./tools";

/** Letters that mean something else on the keyboard. */
const TAKEN = ["D", "F", "G", "H", "U", "Y"];

describe("tools", () => {
  it("each has a key of its own", () => {
    const keys = TOOL_NAMES.map((name) => descriptorOf(name).key);
    expect(new Set([...keys, ...TAKEN]).size).toBe(TOOL_NAMES.length + TAKEN.length);
    expect(keys.filter((key) => !/^[A-Z]$/.test(key))).toEqual([]);
    expect(TOOL_NAMES.map((name) => toolOfKey(descriptorOf(name).key.toLowerCase()))).toEqual(TOOL_NAMES);
    expect(toolOfKey("escape")).toBeUndefined();
  });

  it("each thing that the page asks for has one tool that does it", () => {
    const services = TOOL_NAMES.flatMap((name) => descriptorOf(name).serves ?? []);
    expect([...services].sort()).toEqual(["bend", "cut", "plant"]);
    expect(services.map(toolFor).map((name) => descriptorOf(name).serves)).toEqual(services);
  });

  it("the first stands first", () => {
    expect(TOOL_NAMES[0]).toBe(FIRST_TOOL);
  });

  it("each says all of its texts in every language, in print's own signs", async () => {
    const later = await laterOfAll();
    const texts = TOOL_NAMES.flatMap((name): Text[] => {
      const { label, title } = descriptorOf(name);
      return [label, title, ...later[name].HELP.flatMap(({ title, text, words }) => [title, text, words])];
    });
    expect(texts.length).toBeGreaterThan(5 * TOOL_NAMES.length);
    const lacking = texts.filter(
      (text) => text.length !== LANGUAGES.length || text.some((words) => !words || /\.\.\.|\s$|^\s| {2}/.test(words)),
    );
    expect(lacking).toEqual([]);
  });

  it("each stands in the help, and brings the views it announces", async () => {
    const later = await laterOfAll();
    for (const name of TOOL_NAMES) {
      const { HELP, Options, Marks } = later[name];
      expect(HELP.length, name).toBeGreaterThan(0);
      expect(Options !== undefined || Marks !== undefined, name).toBe(descriptorOf(name).hasViews === true);
    }
  });
});
