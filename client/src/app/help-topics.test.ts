import { afterEach, describe, expect, it } from "vitest";
import { helpGroups, searched } from "./help-topics";
import { language } from "./words";

const found = (query: string) => searched(helpGroups(), query).flatMap(({ topics }) => topics.map(({ id }) => id));

describe("help", () => {
  afterEach(() => {
    language.value = "en";
  });

  it("every topic has a title and a text, and is told apart", () => {
    const topics = helpGroups().flatMap(({ topics }) => topics);
    expect(topics.length).toBeGreaterThan(40);
    expect(topics.every(({ title, text }) => title !== "" && text !== "")).toBe(true);
    const ids = helpGroups().map(({ topics }) => topics.map(({ id }) => id));
    for (const group of ids) expect(new Set(group).size).toBe(group.length);
  });

  it("finds gestures, tools, parameters and keys", () => {
    expect(found("pinch")).toContain("width");
    expect(found("three fingers")).toContain("card-move");
    expect(found("apical dominance")).toContain("parameters.apical_control");
    expect(found("undo")).toContain("help.key.undo");
    expect(found("season")).toContain("leaves.season");
  });

  it("each word must occur, whatever case and accents", () => {
    expect(found("PÏNCH  around")).toContain("width");
    expect(found("pinch elephant")).toEqual([]);
    expect(found("").length).toBe(helpGroups().flatMap(({ topics }) => topics).length);
  });

  it("speaks the language of the page", () => {
    language.value = "de";
    expect(found("zurueckwachsen")).toEqual([]);
    expect(found("ruckgangig")).toContain("help.key.undo");
    expect(found("Jahreszeit")).toContain("leaves.season");
  });
});
