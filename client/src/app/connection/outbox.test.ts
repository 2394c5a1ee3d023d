import { describe, expect, it } from "vitest";
import type { Command } from "../../wire/generated";
import { Outbox } from "./outbox";

const undo: Command = { kind: "undo" };
const redo: Command = { kind: "redo" };

/** One with so many commands in it. */
function holding(count: number): Outbox {
  const outbox = new Outbox();
  for (let i = 0; i < count; i++) outbox.put(undo);
  return outbox;
}

const numbers = (outbox: Outbox) => outbox.pending.map(({ id }) => id);

describe("commands on their way", () => {
  it("CM1: are numbered from 1 and kept in order", () => {
    const outbox = new Outbox();
    expect([outbox.next, outbox.settled]).toEqual([1, 0]);
    expect([outbox.put(undo), outbox.put(redo)]).toEqual([1, 2]);
    expect(outbox.pending.map(({ id, command }) => [id, command])).toEqual([
      [1, undo],
      [2, redo],
    ]);
    expect(outbox.next).toBe(3);
  });

  it("CM2: go once an acknowledgement has passed them", () => {
    const outbox = holding(4);
    outbox.acknowledge(3);
    expect([numbers(outbox), outbox.settled]).toEqual([[4], 3]);
    outbox.acknowledge(2);
    expect(outbox.record().acknowledged, "an older answer takes nothing back").toBe(3);
    outbox.acknowledge(4);
    expect([numbers(outbox), outbox.settled]).toEqual([[], 4]);
  });

  it("CM1: are numbered on from what the server has", () => {
    // An earlier page of this tab may have sent more than it could write down.
    const outbox = new Outbox({ next: 3, acknowledged: 1, pending: [{ id: 2, command: undo }] });
    outbox.acknowledge(7);
    expect([numbers(outbox), outbox.put(redo)]).toEqual([[], 8]);
  });

  it("CM3: that are refused keep their number, yet are settled", () => {
    const outbox = holding(3);
    expect([outbox.commandOf(1), outbox.refuse(1), outbox.refuse(1)]).toEqual([undo, true, false]);
    expect([numbers(outbox), outbox.settled, outbox.unsettled("undo")]).toEqual([[1, 2, 3], 1, 2]);
    outbox.refuse(3);
    expect(outbox.settled, "the second is still open").toBe(1);
    outbox.acknowledge(2);
    expect(outbox.settled).toBe(3);
  });

  it("CM3: a refusal of a number that is gone is news, and changes nothing", () => {
    const outbox = holding(1);
    outbox.acknowledge(1);
    expect([outbox.commandOf(1), outbox.refuse(1), outbox.settled]).toEqual([undefined, true, 1]);
  });

  it("are counted by kind", () => {
    const outbox = holding(2);
    outbox.put(redo);
    expect([outbox.unsettled("undo"), outbox.unsettled("redo"), outbox.unsettled("stop")]).toEqual([2, 1, 0]);
  });
});

describe("a command that goes before others", () => {
  const stop: Command = { kind: "stop" };

  it("LM23: has the number of the first of them, and those the next ones", () => {
    const outbox = holding(3);
    outbox.put(redo);
    outbox.acknowledge(1);
    outbox.overtake(3, stop);
    expect(outbox.pending.map(({ id, command }) => [id, command])).toEqual([
      [2, undo],
      [3, stop],
      [4, undo],
      [5, redo],
    ]);
    expect([outbox.next, outbox.put(undo), outbox.commandOf(5), outbox.commandOf(6)]).toEqual([6, 6, redo, undo]);
  });

  it("LM23: does not settle what it has overtaken", () => {
    const outbox = holding(3);
    outbox.overtake(2, stop);
    outbox.acknowledge(2);
    expect([outbox.settled, outbox.answered, outbox.idThrough(2)]).toEqual([1, 2, 1]);
    outbox.acknowledge(3);
    expect([outbox.settled, outbox.idThrough(3)], "the second of the page is the third of the server").toEqual([2, 2]);
    outbox.acknowledge(4);
    expect([outbox.settled, outbox.answered, outbox.idThrough(4)]).toEqual([4, 4, 4]);
  });

  it("LM23: may be refused, and those after it", () => {
    const outbox = holding(2);
    outbox.overtake(1, stop);
    expect([outbox.refuse(1), outbox.refuse(1), outbox.settled, outbox.answered]).toEqual([true, false, 0, 1]);
    outbox.refuse(2);
    expect([outbox.settled, outbox.answered, outbox.unsettled("undo")]).toEqual([1, 2, 1]);
  });

  it("CM11: without one, what is done has the number that the page knows", () => {
    const outbox = holding(4);
    outbox.acknowledge(2);
    expect([1, 2, 3, 4, 9].map((number) => outbox.idThrough(number))).toEqual([1, 2, 3, 4, 9]);
  });
});

describe("what the server says it has", () => {
  it("CM1: must reach up to what is kept", () => {
    const outbox = holding(3);
    outbox.acknowledge(2);
    expect([1, 2, 3].map((id) => outbox.follows(id))).toEqual([false, true, true]);
  });

  it("CM1: and up to what was sent, if all of it was answered", () => {
    const outbox = holding(3);
    outbox.acknowledge(3);
    expect([2, 3].map((id) => outbox.follows(id))).toEqual([false, true]);
  });
});

describe("commands that outlive their page or key", () => {
  it("CM1: go on where they were in the next page", () => {
    const before = holding(3);
    before.acknowledge(1);
    before.refuse(2);
    const after = new Outbox(JSON.parse(JSON.stringify(before.record())));
    expect(after.record()).toEqual(before.record());
    // It was refused to the page before; this one gets the refusal again.
    expect([numbers(after), after.settled]).toEqual([[2, 3], 1]);
  });

  it("HS4: start at 1 under another key, without what was refused", () => {
    const outbox = holding(2);
    outbox.put(redo);
    outbox.acknowledge(1);
    outbox.refuse(2);
    outbox.startAnew();
    expect(outbox.record()).toEqual({ next: 2, acknowledged: 0, pending: [{ id: 1, command: redo }] });
  });

  it("HS4: a stroke or bend without its beginning stays behind", () => {
    const outbox = new Outbox();
    outbox.put({ kind: "stroke_begin", stroke: 1 });
    outbox.acknowledge(1);
    outbox.put({ kind: "stroke_end", stroke: 1 });
    outbox.put({ kind: "bend_end", bend: 2 });
    outbox.put({ kind: "stroke_begin", stroke: 4 });
    outbox.put({ kind: "stroke_end", stroke: 4 });
    outbox.startAnew();
    expect(outbox.pending.map(({ command }) => command)).toEqual([
      { kind: "stroke_begin", stroke: 4 },
      { kind: "stroke_end", stroke: 4 },
    ]);
  });
});
