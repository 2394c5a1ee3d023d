import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Command, Deed, OperationKind, Person, TimelineOperation } from "../../../wire/generated";
import { OwnUndo } from "./own-undo";

const STROKE: Deed = { id: 4, kind: "stroke", away: true, fell: 12, rose: 0, held: 0 };
const TAKE_BACK: Command = { kind: "take_back" };

/** An operation of the person with this number; number 1 is at the page. */
function by(author: number, kind: OperationKind = "stroke", rest: Partial<TimelineOperation> = {}): TimelineOperation {
  return { kind, author, first: 0, last: 1, ...rest };
}

interface Case {
  /** What those are called who are here, the one at the page first. */
  here?: (string | undefined)[];
  /** What those are called who have left, by their numbers. */
  left?: Record<number, string>;
  canUndo?: boolean;
  canRedo?: boolean;
  line?: TimelineOperation[];
  /** How many of the line are in force. */
  done?: number;
}

function setUp({ here = [undefined], left = {}, canUndo = true, canRedo = true, line = [], done }: Case = {}) {
  const sent: Command["kind"][] = [];
  const said: string[] = [];
  const people = here.map(
    (name, i): Person => ({
      person: i + 1,
      ...(name === undefined ? {} : { name }),
      role: "editor",
      devices: [{ device: 10 + i, state: "here" }],
    }),
  );
  const undo = new OwnUndo({
    document: signal({ can_undo: canUndo, can_redo: canRedo }),
    time: { timeline: signal({ operations: line, done: done ?? line.length }) },
    together: {
      people: signal({ type: "people", you: 10, people, more: 0 }),
      authors: signal(Object.entries(left).map(([person, name]) => ({ person: Number(person), name }))),
    },
    toasts: { show: (text: string) => void said.push(text) },
    submit: ({ kind }: Command) => void sent.push(kind),
  });
  return { undo, sent, said };
}

describe("everyone's own undo", () => {
  it("UD1: takes back what is one's own, whoever is here", () => {
    for (const here of [[undefined], ["Ann", "Bo"]]) {
      const { undo, sent } = setUp({ here });
      undo.undo();
      undo.redo();
      expect(sent).toEqual(["take_back", "bring_back"]);
    }
  });

  it("shows what it did, and says so only where others take part", () => {
    const alone = setUp({ line: [by(1), by(1, "appearance")] });
    alone.undo.done(STROKE);
    expect(alone.said).toEqual([]);
    const together = setUp({ here: ["Ann", "Bo"] });
    const left = setUp({ line: [by(1), by(2)] });
    for (const { undo, said } of [together, left]) {
      undo.done(STROKE);
      undo.done({ ...STROKE, away: false });
      expect(said).toEqual(["Undone: Stroke", "Redone: Stroke"]);
    }
  });

  it("UD7: tells how much stays since others' wood stands on it", () => {
    const { undo, said } = setUp({ here: ["Ann", "Bo"] });
    undo.done({ ...STROKE, held: 42 });
    undo.done({ ...STROKE, passed: 2 });
    expect(said).toEqual([
      "Undone: Stroke. 42 internodes stay, which bear what others drew.",
      "Undone: Stroke. Of what you did after it (2) nothing is left to undo.",
    ]);
  });

  it("UD7: says whose the last deeds are where none is one's own", () => {
    const line = [
      by(3),
      by(1, "stroke", { away: true }),
      by(2, "stroke", { parts: [{ author: 2 }, { author: 1, away: true }] }),
      by(4, "stroke", { away: true }),
      by(1, "taken_back"),
    ];
    const { undo, said } = setUp({ here: ["Ann", "Bo"], left: { 3: "Cy" }, line });
    expect(undo.refused({ reason: "nothing-of-yours" }, TAKE_BACK)).toBe(true);
    expect(said).toEqual([
      "Nothing of yours is left to undo. What was done last is by Bo and Cy; the timeline goes back through it.",
    ]);
    // Whoever nobody has met has a number.
    const unmet = setUp({ line: [by(1, "stroke", { away: true }), by(7)] });
    unmet.undo.refused({ reason: "nothing-of-yours" }, TAKE_BACK);
    expect(unmet.said[0]).toMatch(/is by Person 7;/);
  });

  it("leaves all other refusals to those who say them", () => {
    const { undo, said } = setUp({ line: [by(2)], canRedo: false });
    expect(undo.refused({ reason: "being-bent" }, TAKE_BACK)).toBe(false);
    expect(undo.refused({ reason: "nothing-to-redo" }, { kind: "bring_back" })).toBe(false);
    expect(undo.refused({ reason: "nothing-of-yours" }, { kind: "prune", rows: [1] })).toBe(false);
    expect(undo.refused({ reason: "nothing-of-yours" })).toBe(false);
    expect(said).toEqual([]);
  });

  it("UD3: says that what lies ahead on the line is not what one took back", () => {
    const { undo, said } = setUp({ line: [by(2), by(2)], done: 1 });
    expect(undo.refused({ reason: "nothing-to-redo" }, { kind: "bring_back" })).toBe(true);
    expect(said).toEqual([
      "Nothing that you took back is left to redo. The timeline goes forward through what lies ahead.",
    ]);
  });

  it("UD3: may be asked for redo where one took something back and did not bring it back", () => {
    const none = { canUndo: false, canRedo: false };
    expect(setUp(none).undo.may("undo")).toBe(false);
    expect(setUp({ ...none, line: [by(2)] }).undo.may("redo")).toBe(false);
    const line = [by(2), by(1, "stroke", { away: true }), by(1, "taken_back")];
    expect(setUp({ ...none, line }).undo.may("redo")).toBe(true);
    expect(setUp({ ...none, line, done: 2 }).undo.may("redo")).toBe(false);
    const brought = [by(2), by(1), by(1, "taken_back"), by(1, "brought_back")];
    expect(setUp({ ...none, line: brought }).undo.may("redo")).toBe(false);
    const ofOthers = [by(1), by(2, "stroke", { away: true }), by(2, "taken_back")];
    expect(setUp({ ...none, line: ofOthers }).undo.may("redo")).toBe(false);
  });

  it("UD4: goes back and forth on a line of one's own, and on one of several not through what lies ahead", () => {
    const ahead = { canRedo: true, done: 1 };
    expect(setUp({ ...ahead, line: [by(1), by(1)] }).undo.may("redo")).toBe(true);
    const shared = setUp({ ...ahead, line: [by(1), by(2)] });
    expect(shared.undo.may("redo")).toBe(false);
    shared.undo.tapped(3);
    expect(shared.said).toEqual([
      "Nothing that you took back is left to redo. The timeline goes forward through what lies ahead.",
    ]);
  });
});

describe("a tap of several fingers", () => {
  it("undoes with two and redoes with three, and says what", () => {
    const { undo, sent, said } = setUp();
    undo.tapped(2);
    undo.done({ ...STROKE, kind: "prune" });
    undo.tapped(3);
    undo.done({ ...STROKE, away: false });
    expect(sent).toEqual(["take_back", "bring_back"]);
    expect(said).toEqual(["Undone: Pruning", "Redone: Stroke"]);
  });

  it("says where there is nothing, and does nothing with other numbers", () => {
    const { undo, sent, said } = setUp({ canUndo: false, canRedo: false });
    undo.tapped(2);
    undo.tapped(3);
    undo.tapped(4);
    expect(said).toEqual(["There is nothing to undo.", "There is nothing to redo."]);
    expect(sent).toEqual([]);
  });

  it("that was refused leaves nothing to say later", () => {
    const { undo, said } = setUp();
    undo.tapped(2);
    undo.refused({ reason: "being-bent" }, TAKE_BACK);
    undo.tapped(2);
    undo.forget();
    undo.done(STROKE);
    expect(said).toEqual([]);
  });
});
