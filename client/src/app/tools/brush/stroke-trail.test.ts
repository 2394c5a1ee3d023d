import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../../scene/vector";
import { FADE, type Grown, StrokeTrail } from "./stroke-trail";

/** Wood with nodes at these places, the first a seed. */
function wood(...nodes: Vec3[]): Grown {
  return { rows: nodes.length, position: nodes.flat(), parent: nodes.map((_, row) => row - 1) };
}

const SEED: Vec3 = [0, 0, 0];

/** A stroke from the seed upwards, as high as so many internodes. */
function drawn(height = 10) {
  const trail = new StrokeTrail();
  trail.grown(wood(SEED));
  trail.begin(7);
  for (let y = 0; y <= height; y += 0.5) {
    trail.add(7, [0, y, 0], 0);
  }
  return trail;
}

const ends = (trail: StrokeTrail, now = 0) =>
  trail.ghosts(now).map(({ places }) => [places[0]?.position, places.at(-1)?.position]);
const stem = (height: number): Vec3[] => Array.from({ length: height + 1 }, (_, y): Vec3 => [0, y, 0]);

describe("the ghost of a stroke", () => {
  it("is where the brush is, however little that has moved", () => {
    const trail = drawn(2);
    trail.add(7, [0.01, 2, 0], 0);
    trail.add(7, [0.02, 2, 0], 0);
    expect(ends(trail)).toEqual([[SEED, [0.02, 2, 0]]]);
    expect(trail.shown.value).toBe(true);
  });

  it("goes from its foot as wood comes, and keeps its tip", () => {
    const trail = drawn();
    trail.grown(wood(...stem(4)));
    expect(ends(trail)).toEqual([
      [
        [0, 4, 0],
        [0, 10, 0],
      ],
    ]);
    trail.grown(wood(...stem(10)));
    expect(ends(trail), "wood has come to the brush").toEqual([]);
    trail.add(7, [0, 12, 0], 0);
    expect(ends(trail), "which moves on").toEqual([
      [
        [0, 10, 0],
        [0, 12, 0],
      ],
    ]);
    trail.end(7, 12);
    trail.grown(wood(...stem(12)));
    expect([trail.ghosts(0), trail.shown.value]).toEqual([[], false]);
  });

  it("is not shortened by wood that stood before, nor by what grows elsewhere", () => {
    const trail = new StrokeTrail();
    trail.grown(wood(...stem(10)));
    trail.begin(7);
    trail.add(7, [0, 5, 0], 0);
    trail.add(7, [5, 8, 0], 0);
    trail.grown(wood(...stem(10), [-3, 5, 0]));
    expect(ends(trail)).toEqual([
      [
        [0, 5, 0],
        [5, 8, 0],
      ],
    ]);
  });

  it("a way that comes back past its beginning is not taken for done there", () => {
    const trail = new StrokeTrail();
    trail.begin(7);
    const around = Array.from({ length: 41 }, (_, i) => (2 * Math.PI * i) / 40);
    for (const angle of around) {
      trail.add(7, [8 * Math.cos(angle), 20 + 8 * Math.sin(angle), 0], 0);
    }
    trail.grown(wood(SEED, [8, 20, 0]));
    expect(trail.ghosts(0)[0]!.places.length).toBeGreaterThan(30);
  });

  it("CM11: what wood has not come to when nothing is left to grow fades", () => {
    const trail = drawn();
    trail.end(7, 12);
    trail.done(11);
    expect(trail.ghosts(0)[0]?.opacity).toBe(1);
    trail.done(12);
    expect(trail.ghosts(1000)[0]?.opacity).toBe(1);
    expect(trail.ghosts(1000 + FADE / 2)[0]?.opacity).toBeCloseTo(0.5);
    expect([trail.ghosts(1000 + FADE), trail.shown.value]).toEqual([[], false]);
  });

  it("a stroke that goes on is not over when all before it is done", () => {
    const trail = drawn();
    trail.done(99);
    expect(trail.ghosts(0)[0]?.opacity).toBe(1);
  });

  it("SG2: shows no limb where none can grow, and one from where wood comes after all", () => {
    const trail = drawn(20);
    trail.inVain(7);
    expect(trail.ghosts(0)).toEqual([]);
    trail.add(7, [0, 21, 0], 0);
    trail.grown(wood(SEED, [0.5, 18, 0]));
    expect(ends(trail)).toEqual([
      [
        [0.5, 18, 0],
        [0, 21, 0],
      ],
    ]);
    trail.end(7, 12);
    trail.inVain(7);
    trail.ghosts(0);
    expect(trail.ghosts(FADE)).toEqual([]);
  });

  it("leaves nothing behind when strokes are given up, or another tree is shown", () => {
    const refused = drawn();
    refused.leave();
    refused.add(7, [0, 11, 0], 0);
    refused.ghosts(0);
    expect([refused.ghosts(FADE), refused.shown.value]).toEqual([[], false]);
    const other = drawn();
    other.clear();
    expect([other.ghosts(0), other.shown.value]).toEqual([[], false]);
  });

  it("of strokes in quick succession only the last few wait", () => {
    const trail = new StrokeTrail();
    for (let stroke = 0; stroke < 30; stroke += 1) {
      trail.begin(stroke);
      trail.add(stroke, [stroke, 3, 0], 0);
      trail.end(stroke, stroke);
    }
    trail.ghosts(0);
    expect(trail.ghosts(FADE).length).toBeLessThanOrEqual(9);
  });
});
