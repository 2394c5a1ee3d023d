import { describe, expect, it } from "vitest";
import { rotationOf, turningOf } from "./turning";

describe("turning", () => {
  it.each([
    [0, 0],
    [90, 0],
    [-135, 20],
    [33.3, -45],
    [180, 10],
  ])("%d° around and %d° up come back", (turn, tilt) => {
    const rotation = rotationOf({ turn, tilt });
    expect(Math.hypot(...rotation)).toBeCloseTo(1);
    const back = turningOf(rotation);
    expect(Math.cos(((back.turn - turn) * Math.PI) / 180)).toBeCloseTo(1);
    expect(back.tilt).toBeCloseTo(tilt);
  });

  it("turns as three.js does", async () => {
    const { Euler, Quaternion } = await import("three");
    const radians = Math.PI / 180;
    const expected = new Quaternion().setFromEuler(new Euler(0, 40 * radians, 25 * radians, "YZX"));
    rotationOf({ turn: 40, tilt: 25 }).forEach((part, i) => {
      expect(part).toBeCloseTo(expected.toArray()[i]!);
    });
  });

  it("no rotation is none", () => {
    expect(turningOf(undefined)).toEqual({ turn: 0, tilt: 0 });
  });
});
