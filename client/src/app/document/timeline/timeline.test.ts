import { describe, expect, it } from "vitest";
import type { TimelineFuture, TimelineOperation } from "../../../wire/generated";
import { changed, edgeBeside, NOTHING_DONE, TimeScale } from "./timeline";
import { branchings, clusters, forks, peopleOf } from "./timeline-signs";

const operation = (kind: TimelineOperation["kind"], first: number, last: number): TimelineOperation => ({
  kind,
  author: 1,
  first,
  last,
});

const future = (number: number, from: number): TimelineFuture => ({ future: number, from, steps: 5, operations: [] });

/** A stroke, a cut, a change of parameters that takes no step, and growth. */
const LIFE = [
  operation("stroke", 0, 16),
  operation("prune", 16, 17),
  operation("parameters", 17, 17),
  operation("growth", 17, 117),
];

describe("a timeline that changes", () => {
  const all = changed(NOTHING_DONE, { line: 0, step: 117, last_step: 117, done: 4, from: 0, operations: LIFE });

  it("goes on behind what stays", () => {
    const cut = operation("prune", 117, 118);
    const later = changed(all, { line: 0, step: 118, last_step: 118, done: 5, from: 4, operations: [cut] });
    expect(later.operations).toEqual([...LIFE, cut]);
    expect([later.step, later.done]).toEqual([118, 5]);
  });

  it("TT6: is otherwise where something was taken back, and as it was around it", () => {
    const away = { ...operation("prune", 16, 17), away: true };
    const back = operation("taken_back", 117, 117);
    const now = { line: 0, step: 117, last_step: 117, done: 5, from: 4 };
    const later = changed(all, { ...now, operations: [back], changed: [{ at: 1, operation: away }] });
    expect(later.operations).toEqual([LIFE[0], away, LIFE[2], LIFE[3], back]);
    expect(all.operations).toEqual(LIFE);
  });

  it("has another end, and the old one as a future", () => {
    const seed = operation("seed", 17, 18);
    const change = { line: 1, step: 18, last_step: 18, done: 3, from: 2, operations: [seed], futures: [future(0, 17)] };
    const later = changed(all, change);
    expect(later.operations).toEqual([...LIFE.slice(0, 2), seed]);
    expect(later.futures).toHaveLength(1);
    const travelled = changed(later, { line: 1, step: 3, last_step: 18, done: 1, from: 3, operations: [] });
    expect([travelled.operations, travelled.futures]).toEqual([later.operations, later.futures]);
  });
});

describe("the scale of a line of time", () => {
  it("finds each step again at its place", () => {
    const scale = new TimeScale({ operations: LIFE, done: 4 });
    for (let step = 0; step <= 117; step += 1) {
      expect(scale.stepAt(scale.placeOf(step))).toBe(step);
    }
  });

  it("never goes back as steps go on", () => {
    const scale = new TimeScale({ operations: LIFE, done: 4 });
    for (let step = 1; step <= 117; step += 1) {
      expect(scale.placeOf(step)).toBeGreaterThan(scale.placeOf(step - 1));
    }
    expect(scale.placeOf(0)).toBe(0);
    expect(scale.placeOf(117)).toBe(1);
  });

  it("leaves room for a cut beside long growth", () => {
    const scale = new TimeScale({ operations: LIFE, done: 4 });
    expect(scale.placeOf(17) - scale.placeOf(16)).toBeGreaterThan(1 / 20);
  });

  it("tells a change that is undone from one in force", () => {
    const done = new TimeScale({ operations: LIFE, done: 3 });
    const undone = new TimeScale({ operations: LIFE, done: 2 });
    expect(done.placeOf(17)).toBeGreaterThan(undone.placeOf(17));
    expect(undone.stepAt(undone.placeOf(17))).toBe(17);
  });

  it("has one place where nothing was done", () => {
    const scale = new TimeScale({ operations: [], done: 0 });
    expect([scale.placeOf(0), scale.stepAt(0.7), scale.operationAt(0.2)]).toEqual([0, 0, -1]);
  });

  it("names the operation under a place", () => {
    const scale = new TimeScale({ operations: LIFE, done: 4 });
    expect([0, 0.99, 1].map((place) => scale.operationAt(place))).toEqual([0, 3, 3]);
  });
});

describe("signs on the strip", () => {
  it("stand alone where there is room", () => {
    const scale = new TimeScale({ operations: LIFE, done: 4 });
    expect(clusters(scale, 1000, 30).map(({ from, to }) => [from, to])).toEqual([
      [0, 0],
      [1, 1],
      [2, 2],
      [3, 3],
    ]);
  });

  it("share one place where there is none", () => {
    const many = Array.from({ length: 500 }, (_, i) => operation("bend", i, i + 1));
    const scale = new TimeScale({ operations: many, done: 500 });
    const signs = clusters(scale, 700, 32);
    expect(signs.length).toBeLessThanOrEqual(Math.ceil(700 / 32));
    expect(signs.length).toBeGreaterThan(5);
    for (const [i, sign] of signs.entries()) {
      expect(sign.x - (signs[i - 1]?.x ?? -99)).toBeGreaterThanOrEqual(32);
    }
    expect(signs.flatMap(({ from, to }) => Array.from({ length: to - from + 1 }, (_, i) => from + i))).toEqual(
      many.map((_, i) => i),
    );
  });
});

describe("forks", () => {
  it("join where fingers could not tell them apart", () => {
    const scale = new TimeScale({ operations: LIFE, done: 4 });
    const found = forks([future(3, 100), future(1, 0), future(2, 1)], scale, 400, 44);
    expect(found.map((fork) => fork.futures.map((one) => one.future.future))).toEqual([[1, 2], [3]]);
    expect(found[0]?.x).toBe(0);
  });
});

describe("futures", () => {
  it("follow the future they hang on", () => {
    const nested = [future(1, 20), { ...future(2, 9), on: 3 }, future(3, 4), { ...future(4, 6), on: 2 }];
    expect(branchings(nested).map((one) => [one.future.future, one.leaves, one.depth])).toEqual([
      [3, 4, 0],
      [2, 4, 1],
      [4, 4, 2],
      [1, 20, 0],
    ]);
  });

  it("that hang on each other are no way anywhere", () => {
    expect(
      branchings([
        { ...future(1, 2), on: 2 },
        { ...future(2, 2), on: 1 },
      ]),
    ).toEqual([]);
  });

  it("count whoever did something on any line", () => {
    const other = { ...future(1, 2), operations: [{ ...operation("prune", 2, 3), author: 4 }] };
    expect([peopleOf({ operations: LIFE, futures: [] }), peopleOf({ operations: LIFE, futures: [other] })]).toEqual([
      1, 2,
    ]);
    const joint = { ...operation("stroke", 2, 3), parts: [{ author: 1 }, { author: 5, away: true }] };
    expect(peopleOf({ operations: [joint], futures: [] })).toBe(2);
  });
});

describe("the edges of operations", () => {
  it("lie before and after a step", () => {
    expect([edgeBeside(LIFE, 40, -1), edgeBeside(LIFE, 40, 1), edgeBeside(LIFE, 17, -1)]).toEqual([17, 117, 16]);
  });

  it("are found in a life of very many operations", () => {
    const many = Array.from({ length: 200_000 }, (_, i) => operation("growth", i, i + 1));
    expect([edgeBeside(many, 150_000, -1), edgeBeside(many, 150_000, 1)]).toEqual([149_999, 150_001]);
  });

  it("end where time does", () => {
    expect([edgeBeside(LIFE, 0, -1), edgeBeside(LIFE, 117, 1)]).toEqual([0, 117]);
  });
});
