import { describe, expect, it } from "vitest";
import { viewIn } from "./view";

describe("a view in an address", () => {
  it("is none unless something is asked for", () => {
    expect(viewIn("")).toBeNull();
    expect(viewIn("?tree=oak")).toBeNull();
  });

  it("is what is asked for, and the usual otherwise", () => {
    expect(viewIn("?yaw=30&zoom=1.5")).toEqual({ yaw: 30, pitch: -4.6, zoom: 1.5, right: 0, up: 0 });
    expect(viewIn("?pitch=-2&right=0.25&up=-0.1")).toEqual({ yaw: 0, pitch: -2, zoom: 1, right: 0.25, up: -0.1 });
  });

  it("takes what is no number for not asked, and keeps the tree in sight", () => {
    expect(viewIn("?yaw=north&pitch=NaN")?.yaw).toBe(0);
    expect(viewIn("?zoom=0")?.zoom).toBe(0.2);
    expect(viewIn("?zoom=1e9")?.zoom).toBe(20);
  });
});
