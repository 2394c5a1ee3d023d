import { describe, expect, it } from "vitest";
import { PATIENCE, TravelPacer } from "./timeline-pacer";

const quiet = { unsettled: 0, step: 100, revision: 1 };

describe("a playhead that is pulled", () => {
  it("asks for the first step at once", () => {
    expect(new TravelPacer().tick(0, 90, quiet)).toBe(90);
  });

  it("asks for nothing where it stands already", () => {
    expect(new TravelPacer().tick(0, 100, quiet)).toBeNull();
  });

  it("never has two questions open", () => {
    const pacer = new TravelPacer();
    pacer.tick(0, 90, quiet);
    expect(pacer.tick(16, 80, { ...quiet, unsettled: 1 })).toBeNull();
    // Acknowledged is not yet done: the tree must have come.
    expect(pacer.tick(32, 70, quiet)).toBeNull();
    expect(pacer.tick(48, 60, { ...quiet, revision: 2 })).toBe(60);
  });

  it("skips steps the finger has left", () => {
    const pacer = new TravelPacer();
    const asked: number[] = [];
    let state = { ...quiet };
    for (let frame = 0; frame < 60; frame += 1) {
      const step = pacer.tick(frame * 16, 99 - frame, state);
      if (step !== null) {
        asked.push(step);
      }
      // The server needs five frames for each tree.
      if (frame % 5 === 4) {
        state = { unsettled: 0, step: asked[asked.length - 1] ?? 100, revision: state.revision + 1 };
      }
    }
    expect(asked.length).toBeLessThanOrEqual(13);
    expect(asked.length).toBeGreaterThanOrEqual(10);
  });

  it("goes on when a change of time changes no row", () => {
    const pacer = new TravelPacer();
    pacer.tick(0, 90, quiet);
    expect(pacer.tick(PATIENCE + 1, 80, quiet)).toBe(80);
  });

  it("does not ask twice for the same step", () => {
    const pacer = new TravelPacer();
    pacer.tick(0, 90, quiet);
    expect(pacer.tick(5000, 90, { ...quiet, revision: 7 })).toBeNull();
    expect([pacer.followed(90, 100), pacer.followed(89, 100)]).toEqual([true, false]);
  });
});
