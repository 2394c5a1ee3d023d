import { describe, expect, it } from "vitest";
import { Backlog } from "./backlog";

/** One whose commands up to a number are on their way. */
function sending(last: number): Backlog {
  const backlog = new Backlog();
  for (let number = 1; number <= last; number++) backlog.sent(number);
  return backlog;
}

/** Sends what is due, of those up to `last` that there are. */
function send(backlog: Backlog, now: number, last: number) {
  const run = backlog.due(now, last);
  for (let number = run?.from ?? 1; number <= (run?.to ?? 0); number++) backlog.sent(number);
  return run && [run.from, run.to];
}

describe("commands for which there was no room", () => {
  it("LM23: wait until all that was sent after the first has been refused", () => {
    const backlog = sending(5);
    expect([backlog.refused(100, 3, "behind"), backlog.holds, backlog.again]).toEqual([true, true, null]);
    expect(backlog.refused(110, 4, "number-taken")).toBe(true);
    expect(backlog.again, "the fifth is still on its way").toBe(null);
    expect(backlog.refused(120, 5, "number-taken")).toBe(true);
    expect([backlog.since, backlog.again]).toEqual([100, 370]);
  });

  it("LM23: what was refused before the first, or for another reason when nothing waits, is refused", () => {
    const backlog = sending(5);
    expect(backlog.refused(0, 1, "nothing-to-undo")).toBe(false);
    backlog.refused(0, 3, "behind");
    expect(backlog.refused(0, 2, "nothing-to-undo")).toBe(false);
    expect(backlog.again).toBe(null);
  });

  it("LM23: go out one at first, then ever more while they are taken", () => {
    const backlog = sending(3);
    backlog.refused(0, 3, "behind");
    expect(send(backlog, 249, 20)).toBe(null);
    expect(send(backlog, 250, 20)).toEqual([3, 3]);
    expect(send(backlog, 260, 20), "it is not answered").toBe(null);
    backlog.answered(270, 2, 20);
    expect(send(backlog, 270, 20), "that was another one").toBe(null);
    backlog.answered(300, 3, 20);
    expect(send(backlog, 300, 20)).toEqual([4, 5]);
    backlog.answered(310, 4, 20);
    expect(send(backlog, 310, 20), "the fifth is not answered").toBe(null);
    backlog.answered(320, 5, 20);
    expect(send(backlog, 320, 20)).toEqual([6, 9]);
    backlog.answered(330, 9, 20);
    expect(send(backlog, 330, 12)).toEqual([10, 12]);
    backlog.answered(340, 12, 12);
    expect([backlog.holds, backlog.since, send(backlog, 9999, 12)]).toEqual([false, null, null]);
  });

  it("LM23: are tried more and more seldom while nothing is taken, and soon again once something was", () => {
    const backlog = sending(1);
    let now = 0;
    const waits: number[] = [];
    for (let i = 0; i < 6; i++) {
      backlog.refused(now, 1, "behind");
      waits.push(backlog.again! - now);
      now = backlog.again!;
      send(backlog, now, 9);
    }
    expect(waits).toEqual([250, 500, 1000, 2000, 2000, 2000]);
    backlog.answered(now, 1, 9);
    send(backlog, now, 9);
    backlog.refused(now, 3, "behind");
    expect([backlog.again! - now, backlog.since]).toEqual([250, 0]);
    expect(send(backlog, now + 250, 9), "one again").toEqual([3, 3]);
  });

  it("LM23: are tried at once where something is in a hurry, unless an answer is on its way", () => {
    const backlog = sending(2);
    backlog.refused(0, 1, "behind");
    backlog.hurry(10);
    expect(send(backlog, 10, 2)).toBe(null);
    backlog.refused(20, 2, "number-taken");
    backlog.hurry(30);
    expect(send(backlog, 30, 2)).toEqual([1, 1]);
  });

  it("LM23: are all sent after a welcome, so that nothing waits here", () => {
    const backlog = sending(4);
    backlog.refused(0, 2, "behind");
    backlog.forget();
    expect([backlog.holds, backlog.again, backlog.since]).toEqual([false, null, null]);
    backlog.sent(2);
    backlog.refused(5, 2, "behind");
    expect(backlog.again, "nothing was sent after it").toBe(255);
  });
});
