import { afterEach, describe, expect, it } from "vitest";
import { DRAW_MODES, type DrawMode, legendOf, nextDrawMode } from "../../../scene/mode/draw-mode";
import { language, say } from "../../words/say";
import { endsOf } from "./draw-mode-legend";

afterEach(() => {
  language.value = "en";
});

/** The ends of a mode's ramp where the rows' numbers reach so far. */
function ends(mode: DrawMode, least: number, most: number) {
  const legend = legendOf(mode, { least, most });
  return legend && endsOf(legend);
}

describe("legend of a draw mode", () => {
  it("says what both ends of the ramp mean", () => {
    expect(ends("exposure", 0, 1)).toEqual(["deep shade", "full light"]);
    expect(ends("vigor", 0, 1)).toEqual(["weak", "vigorous"]);
    expect(ends("order", 0, 5)).toEqual(["0: trunk", "5"]);
  });

  it("counts age in steps, one step alone", () => {
    expect(ends("age", 3, 40)).toEqual(["new", "37 steps"]);
    expect(ends("age", 4, 5)).toEqual(["new", "1 step"]);
  });

  it("speaks German", () => {
    language.value = "de";
    expect(ends("age", 3, 40)).toEqual(["neu", "37 Schritte"]);
  });

  it("only modes that show a number have a ramp", () => {
    expect(DRAW_MODES.filter((mode) => ends(mode, 0, 1) === null)).toEqual(["lit", "skeleton", "wireframe"]);
  });

  it("each mode teaches something, in a sentence", () => {
    for (const mode of DRAW_MODES) expect(say(`drawmode.${mode}.lesson`)).toMatch(/^[A-Z].{20,}\.$/);
  });
});

describe("the next draw mode", () => {
  it("goes round all of them, either way", () => {
    for (const direction of [1, -1] as const) {
      const seen = new Set<DrawMode>();
      let mode: DrawMode = "lit";
      do {
        seen.add(mode);
        mode = nextDrawMode(mode, direction);
      } while (mode !== "lit" && seen.size <= DRAW_MODES.length);
      expect(seen.size).toBe(DRAW_MODES.length);
    }
    expect(nextDrawMode("lit", 1)).toBe("skeleton");
    expect(nextDrawMode("lit", -1)).toBe("order");
  });
});
