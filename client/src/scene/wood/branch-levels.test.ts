import { describe, expect, it } from "vitest";
import { LEVELS, levelFor } from "./branch-levels";

const FAR = 5;
const NEAR = 40;

const levelOf = (radius: number, internode: number, before: number) =>
  levelFor(Float64Array.of(radius, internode), before);

describe("the level of a metamer", () => {
  it("gets finer as it gets larger on the screen", () => {
    let before = LEVELS.length;
    for (let radius = 0.2; radius < 300; radius *= 1.1) {
      const level = levelOf(radius, radius * 8, -1);
      expect(level).toBeLessThanOrEqual(before);
      before = level;
    }
    expect(before).toBe(0);
  });

  it("is a strip while it is thin, with a curve where that can be seen", () => {
    expect(LEVELS[levelOf(1, FAR, -1)]).toMatchObject({ sides: 0, segments: 1 });
    expect(LEVELS[levelOf(1, NEAR, -1)]).toMatchObject({ sides: 0, segments: 3 });
    expect(LEVELS[levelOf(3, NEAR, -1)]!.sides).toBeGreaterThan(0);
  });

  it.each(LEVELS.slice(0, 4).map(({ from }) => from))("does not flicker about %s pixels", (from) => {
    const first = levelOf(from, NEAR, -1);
    for (const wobble of [0.92, 1.08, 0.9, 1.1]) expect(levelOf(from * wobble, NEAR, first)).toBe(first);
    const below = levelOf(from * 0.99, NEAR, -1);
    expect(below).toBe(first + 1);
    for (const wobble of [0.92, 1.08, 0.9, 1.1]) expect(levelOf(from * wobble, NEAR, below)).toBe(below);
  });

  it("changes in the end, whatever it was before", () => {
    for (let before = 0; before < LEVELS.length; before += 1) {
      for (const [radius, internode] of [
        [0.5, FAR],
        [0.5, NEAR],
        [4, NEAR],
        [10, NEAR],
        [30, NEAR],
        [200, NEAR],
      ] as const) {
        expect(levelOf(radius, internode, before)).toBe(levelOf(radius, internode, -1));
      }
    }
  });
});
