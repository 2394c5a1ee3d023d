import { expect, it } from "vitest";
import { pictureAt, placeOf, turntableOf } from "./turntable";

it("LB9: a tree turns with what pushes it, once around for its own width", () => {
  expect([0, 1, -1, 0.25, -0.25, 0.5, 1.25].map(pictureAt)).toEqual([0, 0, 0, 9, 3, 6, 9]);
  for (let pushed = -2; pushed <= 2; pushed += 0.01) {
    expect(Number.isInteger(pictureAt(pushed)) && pictureAt(pushed) >= 0 && pictureAt(pushed) < 12).toBe(true);
  }
});

it("the strip is moved so that one whole picture is seen", () => {
  expect([placeOf(0), placeOf(11)]).toEqual(["0% 0", "100% 0"]);
  expect(turntableOf("a b", 3)).toBe("/api/v1/trees/a%20b/versions/3/turntable");
});
