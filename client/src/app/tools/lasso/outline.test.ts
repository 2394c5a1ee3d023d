import { describe, expect, it } from "vitest";
import { enclosedArea, type Point2, simplified, simplifiedTo } from "./outline";

const circle = (radius: number, count: number): Point2[] =>
  Array.from({ length: count }, (_, i) => {
    const turn = (2 * Math.PI * i) / count;
    return [radius * Math.cos(turn), radius * Math.sin(turn)];
  });

describe("enclosed area", () => {
  it("is that of simple figures", () => {
    expect(enclosedArea(circle(10, 200))).toBeCloseTo(Math.PI * 100, 0);
    const square: Point2[] = [
      [0, 0],
      [4, 0],
      [4, 4],
      [0, 4],
    ];
    expect(enclosedArea(square)).toBeCloseTo(16);
    expect(enclosedArea([...square].reverse()), "either way round").toBeCloseTo(16);
  });

  it("a figure of eight has both its loops", () => {
    const eight: Point2[] = [
      [0, 0],
      [4, 4],
      [4, 0],
      [0, 4],
    ];
    expect(enclosedArea(eight)).toBeCloseTo(8, 1);
  });

  it("what is gone round twice is outside again", () => {
    expect(enclosedArea([...circle(10, 100), ...circle(10, 100)])).toBeCloseTo(0);
  });

  it("lines, dots and nothing enclose nothing", () => {
    const line: Point2[] = [
      [0, 0],
      [9, 5],
      [20, 5],
    ];
    expect(enclosedArea([...line, ...[...line].reverse()])).toBeCloseTo(0);
    expect(enclosedArea([[0, 0]])).toBe(0);
    expect(enclosedArea([])).toBe(0);
    expect(enclosedArea(Array.from({ length: 9 }, (_, i): Point2 => [i, 3]))).toBe(0);
  });
});

describe("simplified outline", () => {
  it("keeps corners and ends, drops what lies on the way", () => {
    const path: Point2[] = [
      ...Array.from({ length: 50 }, (_, i): Point2 => [i, 0]),
      ...Array.from({ length: 50 }, (_, i): Point2 => [50, i]),
      [50, 50],
    ];
    expect(simplified(path, 0.1)).toEqual([
      [0, 0],
      [50, 0],
      [50, 50],
    ]);
  });

  it("stays within the tolerance, so the area stays", () => {
    const wobbly = circle(100, 2000).map(([x, y], i): Point2 => [x + 0.2 * Math.sin(i * 7), y + 0.2 * Math.cos(i * 5)]);
    const fewer = simplified(wobbly, 0.7);
    expect(fewer.length).toBeLessThan(200);
    expect(enclosedArea(fewer) / enclosedArea(wobbly)).toBeGreaterThan(0.98);
    expect(enclosedArea(fewer) / enclosedArea(wobbly)).toBeLessThan(1.02);
  });

  it("has no more points than asked for, whatever was drawn", () => {
    let at = 1;
    const scribble = Array.from({ length: 20_000 }, (): Point2 => {
      at = (at * 16807) % 2147483647;
      return [at % 997, at % 613];
    });
    const fewer = simplifiedTo(scribble, 0.7, 4096);
    expect(fewer.length).toBeLessThanOrEqual(4096);
    expect(fewer.length).toBeGreaterThan(100);
  });
});
