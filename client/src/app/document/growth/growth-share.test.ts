import { describe, expect, it } from "vitest";
import { GrowthShare } from "./growth-share";

describe("share of growth", () => {
  it("goes from none to nearly all as steps get fewer", () => {
    const share = new GrowthShare();
    expect([40, 30, 20, 4].map((left) => share.of(left))).toEqual([0, 0.25, 0.5, 0.9]);
  });

  it("begins anew with the next growth", () => {
    const share = new GrowthShare();
    share.of(40);
    expect(share.of(0)).toBeNull();
    expect(share.of(10)).toBe(0);
  });

  it("a few steps are not measured", () => {
    const share = new GrowthShare();
    expect([3, 2, 5, 1].map((left) => share.of(left))).toEqual([null, null, null, null]);
  });

  it("more that is asked for is of the same growth", () => {
    const share = new GrowthShare();
    expect([20, 10, 30, 15].map((left) => share.of(left))).toEqual([0, 0.5, 0, 0.5]);
  });
});
