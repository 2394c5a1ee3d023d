import { afterEach, describe, expect, it } from "vitest";
import { PANEL_NAMES, SHEET_NAMES } from "../page/layout";
import { laterOfAll, TOOL_NAMES } from "../tools/tools";
import { language } from "../words/say";
import { helpGroups as groupsOf, searched } from "./help-topics";

const tools = await laterOfAll();
const helpGroups = () => groupsOf(tools);
const found = (query: string) => searched(helpGroups(), query).flatMap(({ topics }) => topics.map(({ id }) => id));

describe("help", () => {
  afterEach(() => {
    language.value = "en";
  });

  it("every topic has a title and a text, and is distinct", () => {
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

  it("every panel, sheet and tool has a topic that shows it", () => {
    const subjects = helpGroups().flatMap(({ topics }) => topics.flatMap(({ subject }) => subject ?? []));
    const shown = (kind: "panel" | "sheet" | "tool" | "place") =>
      new Set(subjects.flatMap((subject) => (kind in subject ? [subject[kind as keyof typeof subject]] : [])));
    expect([...shown("panel")].sort()).toEqual([...PANEL_NAMES, "comments"].sort());
    expect([...shown("tool")].sort()).toEqual([...TOOL_NAMES].sort());
    // Help itself is open where its topic is read: that shows the tour. The others come with what is done to a tree.
    const asked = SHEET_NAMES.filter((name) => !["help", "leave", "versions", "gifts"].includes(name));
    expect([...shown("sheet")].sort()).toEqual(asked.sort());
    expect(subjects.some((subject) => "tour" in subject)).toBe(true);
  });

  it("every control of a panel can be shown where it stands", () => {
    const controls = helpGroups().find(({ title }) => title === "help.group.controls")!.topics;
    const lost = controls.filter(({ subject }) => subject === undefined).map(({ id }) => id);
    expect(lost).toEqual([]);
    const parts = new Set(controls.flatMap(({ subject }) => (subject && "panel" in subject ? [subject.panel] : [])));
    expect([...parts].sort()).toEqual([
      "architecture",
      "background",
      "branches",
      "brush",
      "grammars",
      "leaves",
      "scene",
      "structure",
      "wind",
    ]);
  });

  it("everything is found by what people call it", () => {
    const names: readonly (readonly [string, string, string])[] = [
      ["save", "store", "sichern"],
      ["library", "library", "Bibliothek"],
      ["share", "link", "Leute"],
      ["variations", "batch", "Wald"],
      ["new", "new tree", "neuer Baum"],
      ["download", "export", "exportieren"],
      ["import", "upload", "hochladen"],
      ["settings", "language", "Sprache"],
      ["draw-modes", "false colours", "Falschfarben"],
      ["brush-panel", "pen pressure", "Stiftdruck"],
      ["sun", "sun", "Sonne"],
      ["travel", "timeline", "Zeitleiste"],
      ["fork", "futures", "Zukünfte"],
      ["rotation", "rotation strip", "Drehstreifen"],
      ["help.key.help", "keyboard", "Tastatur"],
      ["scene", "obstacles", "Hindernisse"],
      ["seed", "seed", "Samen"],
      ["undo", "undo", "rückgängig"],
      ["species", "species", "Baumart"],
      ["prune", "eraser", "Radiergummi"],
      ["card-cut", "erase", "radieren"],
      ["width", "thicker", "dicker"],
      ["branch", "duplicate", "duplizieren"],
      ["bend", "warp", "verformen"],
      ["download", "png", "Bildschirmfoto"],
      ["download", "screenshot", "Foto"],
      ["download", "json", "Skelett"],
      ["symmetry", "symmetry", "Symmetrie"],
      ["symmetry", "mirror", "spiegeln"],
      ["size", "height", "Höhe"],
      ["size", "how old", "wie groß"],
      ["fit", "zoom out", "zentrieren"],
      ["fit", "reset view", "Ansicht zurücksetzen"],
      ["card-move", "zoom", "heranholen"],
      ["card-grow", "simulate", "simulieren"],
      ["card-hold", "isolate", "freistellen"],
      ["undo", "two-finger tap", "Zweifingertipp"],
      ["travel", "replay", "abspielen"],
      ["library", "gallery", "Galerie"],
      ["seed", "another tree", "weiterer"],
      ["new", "start over", "von vorn"],
      ["leaves", "autumn", "Herbst"],
      ["settings", "dark mode", "Dunkelmodus"],
      ["api", "script", "Entwickler"],
      ["wind", "sway", "schwanken"],
    ];
    for (const [id, english, german] of names) {
      language.value = "en";
      expect(found(english), english).toContain(id);
      // Who has the page in one language may know the word in the other.
      expect(found(german), german).toContain(id);
      language.value = "de";
      expect(found(german), german).toContain(id);
    }
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
