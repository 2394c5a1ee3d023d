import { describe, expect, test } from "vitest";
import { tableOf } from "../../../test/small-tree";
import { trunkFeet } from "./trunk-feet";

describe("feet of trunks", () => {
  test("are those of trees that live, each as thick as its thickest stem", () => {
    const feet = trunkFeet(
      tableOf([
        { parent: -1, at: [0, 0, 0] },
        { parent: -1, at: [4, 0, 0] },
        { parent: 1, at: [4, 1, 0], radius: 0.2 },
        { parent: 2, at: [4, 2, 0], radius: 0.9 },
        { parent: 1, at: [5, 1, 0], begins: true, radius: 0.5 },
        { parent: -1, at: [8, 0, 0] },
        { parent: 5, at: [8, 1, 0], radius: 0.7, dead: true },
        { parent: -1, at: [12, 0, 0] },
        { parent: 7, at: [12, 1, 0], radius: 0.3 },
      ]),
    );
    expect(feet.map(({ seed }) => seed)).toEqual([1, 7]);
    expect(feet[0]!.radius).toBeCloseTo(0.5, 1);
    expect(feet[1]!.radius).toBeCloseTo(0.3, 1);
  });
});
