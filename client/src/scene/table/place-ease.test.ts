import { describe, expect, it } from "vitest";
import { PlaceEase } from "./place-ease";
import { EASE_SECONDS } from "./radius-ease";

function shown(ease: PlaceEase, now: number, end = 100): Map<number, [number, number]> {
  const rows = new Map<number, [number, number]>();
  ease.step(now, end, (row, from, at, left) => rows.set(row, [from[at]!, left]));
  return rows;
}

describe("places that glide", () => {
  const placed = Float32Array.from({ length: 30 }, () => 1);
  const at = (x: number) => Float32Array.of(x, 1, 1);

  it("what is visibly elsewhere glides there, and then nothing does", () => {
    const ease = new PlaceEase();
    ease.note(3, at(0.5), 0);
    ease.note(4, at(1.001), 0);
    ease.begin(10, placed);
    expect(ease.until).toBeCloseTo(10 + EASE_SECONDS, 9);
    expect([...shown(ease, 10)]).toEqual([[3, [0.5, 1]]]);
    expect(shown(ease, 10 + EASE_SECONDS).get(3)?.[1]).toBe(0);
    expect(shown(ease, 11).size).toBe(0);
  });

  it("what is on its way goes on from where it is when others begin", () => {
    const ease = new PlaceEase();
    ease.note(3, at(0), 0);
    ease.begin(10, placed);
    const [, left] = shown(ease, 10 + EASE_SECONDS / 2).get(3)!;
    ease.note(5, at(0), 0);
    ease.begin(10 + EASE_SECONDS / 2, placed);
    const both = shown(ease, 10 + EASE_SECONDS / 2);
    expect(both.get(3)?.[0]).toBeCloseTo(1 - left, 5);
    expect(both.get(5)).toEqual([0, 1]);
  });

  it("rows that are gone are left out, and too many at once are where they belong", () => {
    const ease = new PlaceEase();
    ease.note(3, at(0), 0);
    ease.note(8, at(0), 0);
    ease.begin(10, placed);
    expect([...shown(ease, 10, 5).keys()]).toEqual([3]);
    for (let row = 0; row < 5000; row += 1) ease.note(row % 10, at(0), 0);
    ease.begin(11, placed);
    expect(shown(ease, 11).size).toBe(0);
  });
});
