import { describe, expect, it } from "vitest";
import {
  asShown,
  isUsual,
  keyOf,
  SHOWN_NAMES,
  SHOWN_ROWS,
  shownOfKey,
  switched,
  USUAL,
} from "../../../scene/mode/shown";
import { toolOfKey } from "../../tools/tools";
import { LATER } from "../../words/later";

describe("parts of the picture", () => {
  it("are switched one by one, and leave the others", () => {
    for (const name of SHOWN_NAMES) {
      const other = switched(USUAL, name);
      expect(other[name]).toBe(!SHOWN_ROWS[name].usual);
      expect(SHOWN_NAMES.filter((any) => other[any] !== USUAL[any])).toEqual([name]);
      expect(isUsual(other)).toBe(false);
      expect(switched(other, name)).toEqual(USUAL);
    }
    expect(isUsual(USUAL)).toBe(true);
  });

  it("have a key each, which means no tool", () => {
    const keys = SHOWN_NAMES.map(keyOf);
    expect(new Set(keys).size).toBe(SHOWN_NAMES.length);
    for (const name of SHOWN_NAMES) {
      expect(shownOfKey(keyOf(name))).toBe(name);
      expect(toolOfKey(keyOf(name))).toBeFalsy();
    }
    expect([shownOfKey("0"), shownOfKey("d")]).toEqual([null, null]);
  });

  it("have a name in every language, each another", () => {
    const names = SHOWN_NAMES.map((name) => LATER[`shown.${name}`]);
    for (const language of [0, 1] as const) {
      expect(new Set(names.map((name) => name[language])).size).toBe(SHOWN_NAMES.length);
    }
  });

  it("are kept as far as they are known", () => {
    const odd = { ...USUAL, texture: false, skeleton: true };
    expect(asShown(JSON.parse(JSON.stringify(odd)))).toEqual(odd);
    expect(asShown({ light: false, shadow: "no", elsewhere: true })).toEqual({ ...USUAL, light: false });
    for (const nothing of [null, 7, "light", []]) expect(asShown(nothing)).toEqual(USUAL);
  });
});
