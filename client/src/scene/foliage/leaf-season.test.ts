import { expect, it } from "vitest";
import type { LeafKind } from "../../wire/generated";
import { seasonOf } from "./leaf-season";

const YEAR = Array.from({ length: 301 }, (_, i) => i / 100);

it("buds burst small, light green and few", () => {
  const spring = seasonOf("ovate", 0);
  expect(spring.unfolded).toBeLessThan(0.3);
  expect(spring.present).toBeLessThan(0.5);
  expect(spring.fresh).toBe(1);
});

it("summer is a whole green crown", () => {
  for (const kind of ["ovate", "palmate", "needle"] as const) {
    expect(seasonOf(kind, 1)).toEqual({ unfolded: 1, present: 1, fresh: 0, turned: 0, withered: 0 });
  }
});

it("autumn turns leaves before it takes them", () => {
  const { turned, present } = seasonOf("palmate", 2);
  expect(turned).toBeGreaterThan(0.8);
  expect(present).toBeGreaterThan(0.7);
  expect(present).toBeLessThan(1);
  expect(seasonOf("palmate", 1.5).present).toBe(1);
});

it("winter leaves broadleaves bare but for what oaks keep", () => {
  for (const kind of ["round", "lanceolate", "palmate", "fan", "compound"] as const) {
    expect(seasonOf(kind, 3).present).toBeCloseTo(0, 9);
  }
  expect(seasonOf("lobed", 3).present).toBeGreaterThan(0.02);
  expect(seasonOf("lobed", 3).present).toBeLessThan(0.1);
  expect(seasonOf("lobed", 3).withered).toBe(1);
});

it("evergreens hardly change", () => {
  for (const kind of ["needle", "scale"] as const) {
    for (const season of YEAR) {
      const { unfolded, present, turned, withered } = seasonOf(kind, season);
      expect(unfolded).toBeGreaterThan(0.9);
      expect([present, turned]).toEqual([1, 0]);
      expect(withered).toBeLessThan(0.2);
    }
  }
});

it("nothing jumps from one day to the next", () => {
  const kinds: LeafKind[] = ["ovate", "lobed", "fan", "needle"];
  for (const kind of kinds) {
    let before = seasonOf(kind, 0);
    for (const season of YEAR) {
      const now = seasonOf(kind, season);
      for (const name of ["unfolded", "present", "fresh", "turned", "withered"] as const) {
        expect(Math.abs(now[name] - before[name])).toBeLessThan(0.03);
        expect(now[name]).toBeGreaterThanOrEqual(-1e-9);
        expect(now[name]).toBeLessThanOrEqual(1);
      }
      before = now;
    }
  }
});
