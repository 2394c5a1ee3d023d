import { describe, expect, it } from "vitest";
import type { Point } from "./ports";
import { screenPlace } from "./screen-place";

/** An eye at z = 10 that looks along −z; at distance 1 the screen is 2 wide. */
function pointOnPlane(x: number, y: number, [, , z]: Point): Point | null {
  const depth = 10 - z;
  return depth > 0 ? [(x / 50 - 1) * depth, (1 - y / 50) * depth, z] : null;
}

describe("screen place", () => {
  it("finds the pixel whose ray meets the point", () => {
    for (const [x, y, z] of [
      [50, 50, 0],
      [10, 80, 4],
      [99, 1, -30],
    ] as const) {
      const point = pointOnPlane(x, y, [0, 0, z]) as Point;
      const place = screenPlace({ pointOnPlane }, point, 100, 100);
      expect(place?.x).toBeCloseTo(x);
      expect(place?.y).toBeCloseTo(y);
    }
  });

  it("says how long an internode is there", () => {
    expect(screenPlace({ pointOnPlane }, [0, 0, 0], 100, 100)?.pixelsPerInternode).toBeCloseTo(5);
    expect(screenPlace({ pointOnPlane }, [0, 0, 5], 100, 100)?.pixelsPerInternode).toBeCloseTo(10);
  });

  it("has no place behind the eye", () => {
    expect(screenPlace({ pointOnPlane }, [0, 0, 20], 100, 100)).toBeNull();
  });
});
