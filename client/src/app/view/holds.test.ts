import { describe, expect, it } from "vitest";
import { Holds } from "./holds";

describe("holds", () => {
  it("last until the last holder lets go", () => {
    const told: boolean[] = [];
    const holds = new Holds((held) => told.push(held));
    const stroke = holds.take();
    const lever = holds.take();
    lever();
    expect([told, holds.held]).toEqual([[true], true]);
    stroke();
    expect([told, holds.held]).toEqual([[true, false], false]);
  });

  it("nobody lets go for another", () => {
    const told: boolean[] = [];
    const holds = new Holds((held) => told.push(held));
    const sun = holds.take();
    const lever = holds.take();
    lever();
    lever();
    expect(told).toEqual([true]);
    sun();
    holds.take();
    sun();
    expect(told).toEqual([true, false, true]);
  });
});
