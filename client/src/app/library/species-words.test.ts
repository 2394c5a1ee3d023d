import { describe, expect, it } from "vitest";
import { DEFAULT_APPEARANCE, type Species } from "../../wire/generated";
import { inShortNames, isNamed } from "./species-words";

const species = (slug: string, name: string, botanical: string): Species => ({
  slug,
  name,
  botanical,
  sentence: "",
  programme: { parameters: {}, stages: [], age: 20 },
  appearance: DEFAULT_APPEARANCE,
});
const oak = species("oak", "Oak", "Quercus robur");
const pines = [
  species("scots-pine", "Scots pine", "Pinus sylvestris"),
  species("stone-pine", "Stone pine", "Pinus pinea"),
];
const all = [oak, species("birch", "Silver birch", "Betula pendula"), ...pines];

describe("names of species that are searched", () => {
  it("stand for the short names that the server knows", () => {
    expect(inShortNames("Eiche", all)).toBe("Eiche|oak");
    expect(inShortNames("alte eiche am See", all)).toBe("alte eiche|oak am See");
    expect(inShortNames("silver", all)).toBe("silver|birch");
    expect(inShortNames("Kiefer quercus", all)).toBe("Kiefer|scots-pine quercus|oak");
    expect(inShortNames("pin", all), "what is in the short name needs no other").toBe("pin");
    expect([inShortNames("ei", all), inShortNames("", all), inShortNames("Eiche", [])]).toEqual(["ei", "", "Eiche"]);
  });

  it("are told from other words", () => {
    expect(["eiche", "am See oak", "", "Birke"].map((words) => isNamed(words, oak))).toEqual([
      true,
      true,
      false,
      false,
    ]);
  });
});
