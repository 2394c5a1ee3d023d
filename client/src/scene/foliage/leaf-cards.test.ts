import { expect, it } from "vitest";
import { BLADE_CARDS, BLADE_STEP, bladesFor, divided, LEAF_TRIANGLES, levelFor, SPRAY_CARDS } from "./leaf-cards";

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

it("a divided leaf has the same card for each of its blades", () => {
  for (const levels of [BLADE_CARDS, SPRAY_CARDS]) {
    for (const [i, { card, index, triangles }] of divided(levels, 5).entries()) {
      const whole = levels[i]!;
      expect([card.count, index.length, triangles]).toEqual(
        [whole.card.count, whole.index.length, whole.triangles].map((n) => 5 * n),
      );
      for (let vertex = 0; vertex < card.count; vertex += 1) {
        const [blade, of] = [Math.floor(vertex / whole.card.count), vertex % whole.card.count];
        expect([card.getX(vertex), card.getY(vertex)]).toEqual([whole.card.getX(of), whole.card.getY(of)]);
        expect(card.getZ(vertex)).toBe(BLADE_STEP * blade + whole.card.getZ(of));
        expect(whole.card.getZ(of)).toBeLessThan(BLADE_STEP);
      }
      expect(Math.max(...index)).toBe(card.count - 1);
    }
  }
});

it("leaves are divided as far as there are triangles for", () => {
  expect(bladesFor(BLADE_CARDS, 100, 7, true)).toBe(7);
  expect(bladesFor(BLADE_CARDS, 10_000_000, 7, false)).toBe(1);
  for (const leaves of [0, 20_000, 90_000, 200_000]) {
    for (const detailed of [false, true]) {
      const blades = bladesFor(BLADE_CARDS, leaves, 9, detailed);
      expect(blades === 1 || 2 * blades * leaves <= LEAF_TRIANGLES).toBe(true);
      expect(bladesFor(BLADE_CARDS, leaves, 4, detailed)).toBe(Math.min(4, blades));
    }
  }
});
