import { expect, it } from "vitest";
import { BLADE_CARDS, LEAF_TRIANGLES, levelFor, SPRAY_CARDS } from "./leaf-cards";

it("a leaf far off is two triangles", () => {
  for (const levels of [BLADE_CARDS, SPRAY_CARDS]) {
    expect(levels[levelFor(levels, 200_000, 6, true)]!.triangles).toBe(2);
    expect(levels[levelFor(levels, 100, 6, true)]!.triangles).toBe(2);
  }
});

it("a leaf under the eye is bent, a spray stands all around", () => {
  for (const levels of [BLADE_CARDS, SPRAY_CARDS]) {
    expect(levels[levelFor(levels, 2000, 200, true)]!.triangles).toBeGreaterThanOrEqual(12);
  }
});

it("leaves keep to their triangles at any distance", () => {
  for (const levels of [BLADE_CARDS, SPRAY_CARDS]) {
    for (const leaves of [0, 1000, 30_000, 60_000, 120_000, 200_000, 300_000]) {
      for (const pixels of [2, 12, 40, 500]) {
        for (const detailed of [false, true]) {
          const { triangles } = levels[levelFor(levels, leaves, pixels, detailed)]!;
          expect(triangles * leaves).toBeLessThanOrEqual(LEAF_TRIANGLES);
          expect(levels[levelFor(levels, leaves, 2 * pixels, detailed)]!.triangles).toBeGreaterThanOrEqual(triangles);
        }
      }
    }
  }
});

it("every card runs from its base to its tip", () => {
  for (const { card, index } of [...BLADE_CARDS, ...SPRAY_CARDS]) {
    const corners = card.array as Float32Array;
    const along = [...corners].filter((_, i) => i % 3 === 1);
    expect([Math.min(...along), Math.max(...along)]).toEqual([0, 1]);
    expect(Math.max(...index)).toBe(card.count - 1);
  }
});
