import { describe, expect, it } from "vitest";
import { Holds } from "./holds";

describe("holds", () => {
  it("last until the last holder lets go", () => {
    const calls: boolean[] = [];
    const holds = new Holds((held) => calls.push(held));
    const stroke = holds.take();
    const lever = holds.take();
    lever();
    expect([calls, holds.held]).toEqual([[true], true]);
    stroke();
    expect([calls, holds.held]).toEqual([[true, false], false]);
  });

  it("each holder lets go for itself only", () => {
    const calls: boolean[] = [];
    const holds = new Holds((held) => calls.push(held));
    const sun = holds.take();
    const lever = holds.take();
    lever();
    lever();
    expect(calls).toEqual([true]);
    sun();
    holds.take();
    sun();
    expect(calls).toEqual([true, false, true]);
  });
});
