import { describe, expect, it } from "vitest";
import type { Command } from "../../../wire/generated";
import { type Backlog, deflectionFor, GrowPacer, growthRate, KEY_RATE } from "./grow-pacer";

const free = { unsettled: 0, pendingSteps: 0 };
const asked = { unsettled: 1, pendingSteps: 0 };
const running = { unsettled: 0, pendingSteps: 1 };

/** Has a command that is due sent, always under the same number. */
function tick(pacer: GrowPacer, now: number, deflection: number, backlog: Backlog): Command | null {
  const command = pacer.tick(now, deflection, backlog);
  if (command) pacer.sent(command, NUMBER);
  return command;
}

const NUMBER = 7;

/**
 * Holds the control for a while, with a server that does each step within a frame; gives the steps asked for, ungrown
 * ones negative.
 */
function hold(deflection: (time: number) => number, milliseconds: number, backlog = free): number[] {
  const pacer = new GrowPacer();
  pacer.press(1);
  const steps: number[] = [];
  for (let time = 0; time < milliseconds; time += 16) {
    const command = tick(pacer, time, deflection(time), backlog);
    if (command?.kind === "grow") steps.push(command.steps);
    if (command?.kind === "ungrow") steps.push(-command.steps);
    pacer.reported(backlog);
  }
  return steps;
}

const total = (steps: number[]) => steps.reduce((sum, step) => sum + step, 0);

describe("grow pacer", () => {
  it("rests at the centre, 1 to 8 steps a second beside it", () => {
    expect(growthRate(0)).toBe(0);
    expect(growthRate(0.1)).toBe(0);
    expect(growthRate(0.121)).toBeCloseTo(1, 1);
    expect(growthRate(1)).toBeCloseTo(8);
    expect(growthRate(-3)).toBeCloseTo(-8);
  });

  it("a key asks for 3 steps a second", () => {
    expect(growthRate(deflectionFor(KEY_RATE))).toBeCloseTo(3);
    expect(total(hold(() => deflectionFor(KEY_RATE), 3000))).toBeGreaterThanOrEqual(9);
    expect(total(hold(() => deflectionFor(KEY_RATE), 3000))).toBeLessThanOrEqual(10);
  });

  it("asks for as many steps as the deflection says", () => {
    expect(total(hold(() => 1, 3000))).toBeGreaterThan(22);
    expect(total(hold(() => 1, 3000))).toBeLessThan(27);
    expect(total(hold(() => 0.125, 3000))).toBeLessThan(6);
  });

  it("pulling down takes growth back", () => {
    expect(total(hold(() => -1, 1000))).toBeLessThan(-7);
  });

  it("a short push is one step", () => {
    expect(hold((time) => (time < 30 ? 0.3 : 0), 500)).toEqual([1]);
  });

  it("waits for the server", () => {
    expect(hold(() => 1, 1000, asked)).toEqual([]);
    expect(hold(() => 1, 1000, running)).toEqual([]);
  });

  it.each([1, -1])("asks for one step, and for the next when the server has reported that it is done", (push) => {
    const pacer = new GrowPacer();
    pacer.press(1);
    expect(tick(pacer, 0, push, free)).toMatchObject({ steps: 1 });
    const none = (from: number, to: number, backlog: Backlog) => {
      for (let time = from; time < to; time += 16) expect(tick(pacer, time, push, backlog)).toBeNull();
    };
    none(16, 300, asked);
    // It was taken on, and what the page knows of the server is older than that.
    none(300, 600, free);
    pacer.reported(running);
    none(600, 3000, running);
    // What was reported before the step was taken on says nothing of it.
    pacer.reported(asked);
    none(3000, 3100, free);
    pacer.reported(free);
    expect(tick(pacer, 3100, push, free)).toMatchObject({ steps: 1 });
  });

  it("does not take it that a step came to nothing because nothing is heard of it, however long that lasts", () => {
    const pacer = new GrowPacer();
    pacer.press(1);
    tick(pacer, 0, 1, free);
    // The step is taken on, and a page that was busy looks at nothing else for a while.
    for (const time of [400, 900, 60_000]) expect(tick(pacer, time, 1, free)).toBeNull();
    pacer.reported(free);
    expect(tick(pacer, 60_016, 1, free)).toMatchObject({ steps: 1 });
  });

  it("CM11: goes on after a step that came to nothing, once nothing is left to do", () => {
    const pacer = new GrowPacer();
    pacer.press(1);
    tick(pacer, 0, -1, free);
    pacer.done(NUMBER - 1);
    expect(tick(pacer, 300, -1, free), "that was about what came before it").toBeNull();
    pacer.done(NUMBER);
    expect(tick(pacer, 316, -1, free)).toMatchObject({ kind: "ungrow" });
  });

  it("has asked for nothing where nothing was sent", () => {
    const pacer = new GrowPacer();
    pacer.press(1);
    pacer.sent(pacer.tick(0, 1, free)!, 0);
    expect(pacer.grows).toBe(false);
    expect(pacer.tick(1000, 1, free)).not.toBeNull();
  });

  it("knows whether growth that was asked for may still go on", () => {
    const pacer = new GrowPacer();
    pacer.press(1);
    expect(pacer.grows).toBe(false);
    tick(pacer, 0, 1, free);
    expect(pacer.grows).toBe(true);
    pacer.reported(running);
    expect(pacer.grows).toBe(true);
    pacer.reported(free);
    expect(pacer.grows).toBe(false);
    tick(pacer, 16, -1, free);
    expect(pacer.grows, "backwards there is nothing to stop").toBe(false);
  });

  it("CM5: all steps of one push carry one gesture", () => {
    const pacer = new GrowPacer();
    pacer.press(77);
    expect(tick(pacer, 0, 1, free)).toEqual({ kind: "grow", steps: 1, gesture: 77 });
    pacer.reported(free);
    expect(tick(pacer, 200, 1, free)).toMatchObject({ gesture: 77 });
  });
});
