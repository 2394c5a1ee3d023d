import { describe, expect, it } from "vitest";
import { Virtual } from "../../../test/virtual-clock";
import { alike, Draft, type GrowthAhead } from "./draft";

interface Look {
  readonly hue: number;
  readonly bark: { readonly kind: string; readonly relief: number };
}

const FIRST: Look = { hue: 0, bark: { kind: "smooth", relief: 1 } };

/** A draft with its clock, and what it has sent. */
function bench(options: { readonly ahead?: () => GrowthAhead; readonly offline?: boolean } = {}) {
  const clock = new Virtual();
  const sent: { patch: Partial<Look>; gesture: number | undefined; at: number }[] = [];
  const draft = new Draft<Look>({
    none: FIRST,
    submit: (patch, gesture) => {
      sent.push({ patch, gesture, at: clock.now() });
      return options.offline ? 0 : sent.length;
    },
    newGesture: () => sent.length + 1,
    ahead: options.ahead ?? (() => ({ step: 0, pending: 0 })),
    clock,
  });
  draft.receive(FIRST);
  return { clock, sent, draft, hue: () => draft.value.value.hue };
}

describe("draft", () => {
  it("shows what a user sets at once", () => {
    const { draft, hue } = bench();
    draft.drag({ hue: 1 });
    expect(hue()).toBe(1);
    expect(draft.value.value.bark).toEqual(FIRST.bark);
  });

  it("sends a drag ten times a second, newest only", () => {
    const { clock, sent, draft } = bench();
    for (let i = 1; i <= 100; i++) {
      draft.drag({ hue: i });
      draft.settle(sent.length);
      clock.pass(10);
    }
    expect(sent.length).toBeGreaterThanOrEqual(9);
    expect(sent.length).toBeLessThanOrEqual(11);
    for (const [i, { at }] of sent.slice(1).entries()) expect(at - sent[i]!.at).toBeGreaterThanOrEqual(100);
    expect(sent.at(-1)!.patch.hue).toBeGreaterThan(85);
  });

  it("AP2: all of one drag carries one gesture", () => {
    const { clock, sent, draft } = bench();
    for (let i = 1; i <= 30; i++) {
      draft.drag({ hue: i });
      draft.settle(sent.length);
      clock.pass(16);
    }
    draft.commit({ hue: 31 });
    expect(sent.length).toBeGreaterThan(3);
    expect(new Set(sent.map(({ gesture }) => gesture))).toEqual(new Set([1]));
    clock.pass(200);
    draft.drag({ hue: 40 });
    draft.commit({ hue: 41 });
    expect(sent.at(-1)!.gesture, "the next drag is another").toBeGreaterThan(1);
    expect(sent.at(-1)!.patch).toEqual({ hue: 41 });
  });

  it("AP2: what is picked has no gesture but the one given", () => {
    const { sent, draft } = bench();
    draft.commit({ hue: 3 });
    draft.commit({ hue: 4 }, 77);
    expect(sent.map(({ gesture }) => gesture)).toEqual([undefined, 77]);
  });

  it("where the user lets go is always sent", () => {
    const { clock, sent, draft } = bench();
    draft.drag({ hue: 1 });
    draft.drag({ hue: 2 });
    draft.commit({ hue: 3 });
    expect(sent.map(({ patch }) => patch.hue)).toEqual([1, 3]);
    clock.pass(5000);
    expect(sent, "and nothing after it").toHaveLength(2);
  });

  it("waits for a server that does not answer", () => {
    const { clock, sent, draft, hue } = bench();
    for (let i = 1; i <= 100; i++) {
      draft.drag({ hue: i });
      clock.pass(20);
    }
    expect(sent).toHaveLength(2);
    expect(hue()).toBe(100);
    draft.settle(1);
    expect(sent).toHaveLength(3);
    expect(sent.at(-1)!.patch.hue, "the newest").toBe(100);
  });

  it("the user's value stands while it is under way", () => {
    const { clock, draft, hue } = bench();
    draft.commit({ hue: 5 });
    draft.receive({ ...FIRST, hue: 2 });
    clock.pass(60_000);
    expect(hue()).toBe(5);
  });

  it("what nobody here has touched is the server's", () => {
    const { draft } = bench();
    draft.drag({ hue: 5 });
    draft.receive({ hue: 2, bark: { kind: "papery", relief: 2 } });
    expect(draft.value.value).toEqual({ hue: 5, bark: { kind: "papery", relief: 2 } });
  });

  it("undo wins once nothing is under way", () => {
    const { draft, hue } = bench();
    draft.commit({ hue: 5 });
    draft.settle(1);
    draft.receive({ ...FIRST, hue: 5 });
    draft.receive({ ...FIRST, hue: 0 });
    expect(hue()).toBe(0);
  });

  it("an answer before the acknowledgement counts too", () => {
    const { draft, hue } = bench();
    draft.commit({ hue: 5 });
    draft.receive({ ...FIRST, hue: 5.000001 });
    draft.settle(1);
    draft.receive({ ...FIRST, hue: 1 });
    expect(hue()).toBe(1);
  });

  it("late news of one's own drag does not pull back", () => {
    const { clock, draft, hue } = bench();
    draft.drag({ hue: 1 });
    clock.pass(150);
    draft.commit({ hue: 2 });
    draft.settle(2);
    draft.receive({ ...FIRST, hue: 1 });
    expect(hue()).toBe(2);
    clock.pass(200);
    draft.receive({ ...FIRST, hue: 2 });
    clock.pass(5000);
    expect(hue()).toBe(2);
  });

  it("what the server refuses springs back", () => {
    const { clock, draft, hue } = bench();
    draft.commit({ hue: 999 });
    draft.settle(1);
    expect(hue()).toBe(999);
    clock.pass(1000);
    expect(hue()).toBe(0);
  });

  it("what waits behind long growth stays as set", () => {
    let ahead = { step: 10, pending: 30 };
    const { clock, draft, hue } = bench({ ahead: () => ahead });
    draft.commit({ hue: 7 });
    draft.settle(1);
    clock.pass(20_000);
    expect(hue()).toBe(7);
    ahead = { step: 40, pending: 0 };
    clock.pass(300);
    expect(hue(), "its turn has only just come").toBe(7);
    draft.receive({ ...FIRST, hue: 7 });
    clock.pass(5000);
    expect(hue()).toBe(7);
  });

  it("growth that was asked for later keeps nothing", () => {
    let ahead = { step: 10, pending: 3 };
    const { clock, draft, hue } = bench({ ahead: () => ahead });
    draft.commit({ hue: 7 });
    draft.settle(1);
    // A lever that is held asks for more all the time, so that the server is never done.
    for (let i = 1; i <= 20; i++) {
      ahead = { step: 10 + i, pending: 3 };
      clock.pass(100);
    }
    expect(hue()).toBe(0);
  });

  it("time that goes back is waited for no longer", () => {
    let ahead = { step: 10, pending: 30 };
    const { clock, draft, hue } = bench({ ahead: () => ahead });
    draft.commit({ hue: 7 });
    draft.settle(1);
    ahead = { step: 4, pending: 2 };
    clock.pass(1000);
    expect(hue()).toBe(0);
  });

  it("a busy server does not keep what it made otherwise", () => {
    const { clock, sent, draft, hue } = bench();
    draft.commit({ hue: 7 });
    draft.settle(1);
    draft.receive({ ...FIRST, hue: 2 });
    for (let i = 0; i < 10; i++) {
      // Others set something else, and this user too: each is sent and answered.
      draft.receive({ hue: 2, bark: { kind: "smooth", relief: i } });
      draft.commit({ bark: { kind: "papery", relief: i } });
      draft.settle(sent.length);
      clock.pass(100);
    }
    expect(hue()).toBe(2);
  });

  it("letting go changes nothing by itself", () => {
    const { clock, sent, draft } = bench();
    draft.commit();
    expect(sent).toEqual([]);
    draft.drag({ hue: 3 });
    draft.commit();
    clock.pass(1000);
    expect(sent).toHaveLength(1);
  });

  it("without a connection it is soon as it was", () => {
    const { clock, draft, hue } = bench({ offline: true });
    draft.commit({ hue: 7 });
    clock.pass(1000);
    expect(hue()).toBe(0);
  });

  it("under another key it is as the server has it", () => {
    const { draft, hue } = bench();
    draft.commit({ hue: 4 });
    draft.letGo();
    expect(hue()).toBe(0);
    draft.receive({ ...FIRST, hue: 4 });
    expect(hue()).toBe(4);
  });

  it("another session knows nothing of it", () => {
    const { clock, sent, draft, hue } = bench();
    draft.drag({ hue: 1 });
    draft.drag({ hue: 2 });
    draft.clear();
    clock.pass(5000);
    expect(hue()).toBe(0);
    expect(sent).toHaveLength(1);
  });
});

describe("alike", () => {
  it("forgives what 32-bit floats lose, nothing else", () => {
    expect(alike({ a: [0.1, "x"] }, { a: [Math.fround(0.1), "x"] })).toBe(true);
    expect(alike({ a: [0.1, "x"] }, { a: [0.11, "x"] })).toBe(false);
    expect(alike({ a: 1 }, { b: 1 })).toBe(false);
    expect(alike([1, 2], [1])).toBe(false);
    expect(alike(null, {})).toBe(false);
  });
});
