import { readdirSync, readFileSync } from "node:fs";
import { afterEach, describe, expect, it } from "vitest";
import { DEFAULT_APPEARANCE, type Species } from "../../../wire/generated";
import { language } from "../../words/say";
import { SPECIES } from "../../words/species";
import { DEFAULTS } from "../growth/growth-parameters";
import { foundSpecies, kinByProgramme, kinOf, parametersOf, speciesName, speciesSentence } from "./species-choice";

const species = (slug: string, name: string, botanical: string, parameters: object): Species => ({
  slug,
  name,
  botanical,
  sentence: `${name}.`,
  programme: { species: slug, parameters: { ...DEFAULTS, ...parameters }, stages: [], age: 20 },
  appearance: DEFAULT_APPEARANCE,
});
const oak = species("oak", "Oak", "Quercus robur", { branching_angle: 65, max_shoot_length: 3, apical_control: 0.46 });
const birch = species("birch", "Silver birch", "Betula pendula", { branching_angle: 35, setpoint_angle: 120 });
const newcomer = species("hornbeam", "Hornbeam", "Carpinus", { branching_angle: 1, deflection_angle: 2 });
const all = [oak, birch, newcomer];

afterEach(() => {
  language.value = "en";
});

describe("the species of a programme", () => {
  const { programme } = oak;

  it("is the one it says, changed once something is set by hand or edited", () => {
    const found = (inForce: Parameters<typeof kinByProgramme>[1]) => kinByProgramme(all, inForce, DEFAULT_APPEARANCE);
    expect(found({ programme, byHand: [] })).toEqual({ species: oak, changed: false });
    expect(found({ programme, byHand: ["leaf_size"] })).toEqual({ species: oak, changed: true });
    expect(found({ programme: { ...programme, age: 21 }, byHand: [] })?.changed).toBe(true);
    expect(found({ programme: { ...programme, species: "triffid" }, byHand: [] })).toBeNull();
  });
});

describe("the species in force", () => {
  it("is the one whose parameters they are, as 32-bit floats", () => {
    const sent = { ...parametersOf(oak.programme), apical_control: Math.fround(0.46) };
    expect(kinOf(all, sent, DEFAULT_APPEARANCE)).toEqual({ species: oak, changed: false });
  });

  it("is changed once a parameter is another", () => {
    const now = { ...parametersOf(birch.programme), deflection_angle: 20 };
    expect(kinOf(all, now, null)).toEqual({ species: birch, changed: true });
  });

  it("is changed once its leaves are others, not with the sky", () => {
    const { leaves, background } = DEFAULT_APPEARANCE;
    const autumn = { ...DEFAULT_APPEARANCE, leaves: { ...leaves, season: 2 } };
    expect(kinOf(all, parametersOf(oak.programme), autumn)?.changed).toBe(true);
    const evening = { ...DEFAULT_APPEARANCE, background: { ...background, sun_elevation: 3 } };
    expect(kinOf(all, parametersOf(oak.programme), evening)?.changed).toBe(false);
  });

  it("is the one that looks so, else the last picked, where several grow alike", () => {
    const golden = { ...DEFAULT_APPEARANCE, leaves: { ...DEFAULT_APPEARANCE.leaves, season: 2 } };
    const [first, second] = ["first", "second"].map((slug) => ({ ...oak, slug }));
    const third = { ...oak, slug: "third", appearance: golden };
    const alike = [first!, second!, third];
    const found = (looks: typeof golden, picked?: string) =>
      kinOf(alike, parametersOf(oak.programme), looks, picked)?.species.slug;
    expect(found(DEFAULT_APPEARANCE, "second")).toBe("second");
    expect(found(DEFAULT_APPEARANCE)).toBe("first");
    expect(found(golden, "second")).toBe("third");
  });

  it("is none as a session begins, and none for a tree of one's own", () => {
    expect(kinOf(all, DEFAULTS, null)).toBeNull();
    const numbers = Object.entries(parametersOf(oak.programme)).map(([name, value]) => [
      name,
      typeof value === "number" ? value + 0.01 : value,
    ]);
    expect(kinOf(all, Object.fromEntries(numbers), null)).toBeNull();
  });
});

describe("names of species", () => {
  it("are found in every language, without signs above letters", () => {
    const found = (words: string) => foundSpecies(all, words).map(({ slug }) => slug);
    expect(found("oak")).toEqual(["oak"]);
    expect(found("EICHE")).toEqual(["oak"]);
    expect(found("betula")).toEqual(["birch"]);
    for (const typed of ["hange birke", "haenge-birke", "Hänge-Birke"]) expect(found(typed)).toEqual(["birch"]);
    expect(found("  ")).toEqual(["oak", "birch", "hornbeam"]);
    expect(found("fern")).toEqual([]);
  });

  it("every species of the server has a German name and sentence, and no other has", () => {
    const folder = new URL("../../../../../server/growth/src/species/", import.meta.url);
    const sources = readdirSync(folder).map((file) => readFileSync(new URL(file, folder), "utf8"));
    const slugs = sources.flatMap((text) => [...text.matchAll(/\bslug: "([a-z-]+)"/g)].map(([, slug]) => slug));
    expect(slugs.length).toBeGreaterThan(20);
    expect(Object.keys(SPECIES).sort()).toEqual([...new Set(slugs)].sort());
    expect(new Set(Object.values(SPECIES).map(([name]) => name)).size).toBe(slugs.length);
  });

  it("are said in the language spoken; a newcomer has its own", () => {
    language.value = "de";
    expect(speciesName(oak)).toBe("Eiche");
    expect(speciesSentence(birch)).toContain("Stamm");
    expect([speciesName(newcomer), speciesSentence(newcomer)]).toEqual(["Hornbeam", "Hornbeam."]);
  });
});
