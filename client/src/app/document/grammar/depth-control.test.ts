import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Command, GrammarInForce } from "../../../wire/generated";
import { DepthControl, moveTo } from "./depth-control";

const told = (depth: number, earlier = 0, later = 0): GrammarInForce => ({
  text: "",
  title: null,
  at: [0, 0, 0],
  seed: 1,
  sliders: [],
  values: [],
  within: null,
  depth,
  earlier,
  later,
  edited: false,
  ends: null,
});

describe("the way to a depth", () => {
  it("leads through time where the line has it", () => {
    expect(moveTo(told(5, 5, 0), 2, 0)).toEqual({ travel: -3 });
    expect(moveTo(told(2, 2, 3), 4, 3)).toEqual({ travel: 2 });
    expect(moveTo(told(2, 2, 3), 9, 3)).toEqual({ travel: 3 });
  });

  it("derives at the end of the line, and sets a depth where the line has other things", () => {
    expect(moveTo(told(5, 5, 0), 7, 0)).toEqual({ derive: 2 });
    expect(moveTo(told(5, 0, 0), 2, 0)).toEqual({ set: 2 });
    expect(moveTo(told(5, 0, 0), 0, 0)).toEqual({ set: 1 });
    expect(moveTo(told(5, 0, 0), 7, 4)).toEqual({ set: 7 });
    expect(moveTo(told(5), 5, 0)).toEqual({ rest: true });
  });
});

/** A control with a server that does what it is asked when it is told to. */
function bench(first: GrammarInForce) {
  const [inForce, busy] = [signal<GrammarInForce | null>(first), signal(false)];
  const sent: (Command | number)[] = [];
  const waiting: (() => void)[] = [];
  const take = (what: Command | number) => {
    sent.push(what);
    busy.value = true;
    return sent.length;
  };
  const control = new DepthControl({
    inForce,
    busy,
    submit: take,
    travel: take,
    stepsAhead: () => inForce.peek()?.later ?? 0,
    newGesture: () => 77,
    steered: () => {},
    clock: {
      now: () => 0,
      after: (_, run) => {
        waiting.push(run);
        return () => waiting.splice(waiting.indexOf(run), 1);
      },
    },
  });
  const answer = (next: GrammarInForce) => {
    inForce.value = next;
    busy.value = false;
  };
  return { control, sent, answer, busy, waiting };
}

describe("a depth control", () => {
  it("asks for one thing at a time, and for the newest depth that is wanted", () => {
    const { control, sent, answer } = bench(told(3, 3));
    control.commit(4);
    control.commit(5);
    control.commit(6);
    expect([sent, control.shown.value]).toEqual([[{ kind: "derive", steps: 1 }], 6]);
    answer(told(4, 4));
    expect(sent[1]).toEqual({ kind: "derive", steps: 2 });
    answer(told(6, 6));
    expect([sent.length, control.wanted.value]).toEqual([2, null]);
  });

  it("goes back in time for less, and joins what one drag sends", () => {
    const { control, sent, answer } = bench(told(3, 3));
    control.drag(1);
    answer(told(1, 1, 2));
    control.commit(0);
    answer(told(0, 0, 3));
    expect(sent).toEqual([-2, -1]);
    control.drag(5);
    answer(told(3, 3));
    expect(sent.slice(2)).toEqual([3, { kind: "derive", steps: 2, gesture: 77 }]);
  });

  it("gives up what leads nowhere, but not before its answer may be late", () => {
    const { control, sent, busy, waiting } = bench(told(3));
    control.commit(4);
    busy.value = false;
    expect([control.wanted.value, waiting.length]).toEqual([4, 1]);
    waiting[0]?.();
    expect([control.wanted.value, control.shown.value, sent.length]).toEqual([null, 3, 1]);
  });
});
