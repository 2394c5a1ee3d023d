import { describe, expect, it } from "vitest";
import { ShadowDue } from "./shadow-due";

/** One whose map is up to date, drawn at 0. */
function drawn(merged = 0): ShadowDue {
  const due = new ShadowDue();
  due.take(0, 0, false, merged);
  return due;
}

describe("the map of shadows", () => {
  it("is drawn at first, and then not before something changes", () => {
    const due = new ShadowDue();
    expect([due.take(0, 100, false, 0), due.take(1000, 0, false, 0)]).toEqual([true, false]);
    due.stale = true;
    expect([due.take(2000, 0, false, 0), due.stale]).toEqual([true, false]);
  });

  it("waits as long as the quality wants, and is then made up for", () => {
    const due = drawn();
    due.stale = true;
    expect([due.take(99, 100, false, 0), due.stale, due.take(100, 100, false, 0)]).toEqual([false, true, true]);
  });

  it("follows growth, and is drawn once more when that has ended", () => {
    const due = drawn();
    expect([16, 32, 48].map((now) => due.take(now, 0, true, 0))).toEqual([true, true, true]);
    expect([64, 80].map((now) => due.take(now, 0, false, 0))).toEqual([true, false]);
  });

  it("follows leaves that give way to sprigs, in steps", () => {
    const due = drawn(0.5);
    expect([0.55, 0.61, 0.66, 0.7].map((merged) => due.take(16, 0, false, merged))).toEqual([
      false,
      false,
      true,
      false,
    ]);
    expect(due.take(32, 0, false, 0.5), "and back").toBe(true);
  });

  it("is not drawn again because leaves give way in haste", () => {
    const due = new ShadowDue();
    due.take(0, 0, false, 0.1);
    expect(due.take(9000, 0, false, null)).toBe(false);
    expect(due.take(10_000, 0, false, 0.15), "nor at rest, where they are as before").toBe(false);
    expect(due.take(11_000, 0, false, 0.9)).toBe(true);
  });

  it("is drawn coarser only when it is drawn anyway, and finer as soon as a finer one is wanted", () => {
    const due = drawn();
    expect([due.take(16, 0, false, 0, 0.5), due.isDue], "a fine one serves").toEqual([false, false]);
    due.stale = true;
    expect([due.take(32, 0, false, 0, 0.5), due.isDue, due.stale]).toEqual([true, true, false]);
    expect(due.take(48, 0, false, 0, 0.25)).toBe(false);
    expect(due.take(64, 100, false, 0, 1), "not before its time").toBe(false);
    expect([due.take(132, 100, false, 0, 1), due.isDue]).toEqual([true, false]);
  });
});
