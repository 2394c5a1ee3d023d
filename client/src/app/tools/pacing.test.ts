import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { pace } from "./pacing";

describe("pacing", () => {
  beforeEach(() => vi.useFakeTimers({ now: 0 }));
  afterEach(() => vi.useRealTimers());

  it("calls thirty times a second", () => {
    const act = vi.fn();
    pace(33, act);
    vi.advanceTimersByTime(990);
    expect(act).toHaveBeenCalledTimes(30);
  });

  it("does not catch up after a slow frame", () => {
    const times: number[] = [];
    pace(33, () => {
      times.push(Date.now());
      // The first call holds the page up for as long as a very slow frame.
      if (times.length === 1) vi.setSystemTime(Date.now() + 700);
    });
    vi.advanceTimersByTime(330);
    expect(times).toHaveLength(10);
    const spacings = times.slice(1).map((time, i) => time - times[i]!);
    expect(Math.min(...spacings)).toBeGreaterThanOrEqual(33);
    expect(spacings[0]).toBe(733);
  });

  it("stops, even from within a call", () => {
    const act = vi.fn(() => stop());
    const stop = pace(33, act);
    vi.advanceTimersByTime(500);
    expect(act).toHaveBeenCalledTimes(1);
  });
});
