import { describe, expect, it } from "vitest";
import { deflectionFor, GrowPacer, growthRate, KEY_RATE } from "./grow-pacer";

const free = { unsettled: 0, pendingSteps: 0 };

/** Holds the control for a while; gives the steps asked for, ungrown ones negative. */
function hold(deflection: (time: number) => number, milliseconds: number, backlog = free): number[] {
  const pacer = new GrowPacer();
  pacer.press(1);
  const steps: number[] = [];
  for (let time = 0; time < milliseconds; time += 16) {
    const command = pacer.tick(time, deflection(time), backlog);
    if (command?.kind === "grow") steps.push(command.steps);
    if (command?.kind === "ungrow") steps.push(-command.steps);
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
    expect(hold(() => 1, 1000, { unsettled: 2, pendingSteps: 0 })).toEqual([]);
    expect(hold(() => 1, 1000, { unsettled: 0, pendingSteps: 100 })).toEqual([]);
  });

  it("does not make up for steps the server had no time for", () => {
    const pacer = new GrowPacer();
    pacer.press(1);
    for (let time = 0; time < 5000; time += 16) {
      pacer.tick(time, 1, { unsettled: 2, pendingSteps: 0 });
    }
    const command = pacer.tick(5000, 1, free);
    expect(command?.kind === "grow" ? command.steps : 0).toBeLessThanOrEqual(2);
  });

  it("CM5: all steps of one push carry one gesture", () => {
    const pacer = new GrowPacer();
    pacer.press(77);
    expect(pacer.tick(0, 1, free)).toEqual({ kind: "grow", steps: 1, gesture: 77 });
    expect(pacer.tick(200, 1, free)).toMatchObject({ gesture: 77 });
  });
});
