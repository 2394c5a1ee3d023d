import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Command, Deed, Person } from "../../../wire/generated";
import { OwnUndo } from "./own-undo";

const STROKE: Deed = { id: 4, kind: "stroke", away: true, fell: 12, rose: 0, held: 0 };

function setUp({ people = 1, canUndo = true, canRedo = true } = {}) {
  const sent: Command["kind"][] = [];
  const said: string[] = [];
  const all = Array.from({ length: people }, (_, i): Person => ({ person: i + 1, role: "editor", devices: [] }));
  const undo = new OwnUndo({
    document: signal({ can_undo: canUndo, can_redo: canRedo }),
    together: { people: signal({ people: all }) },
    toasts: { show: (text: string) => void said.push(text) },
    submit: ({ kind }: Command) => void sent.push(kind),
  });
  return { undo, sent, said };
}

describe("everyone's own undo", () => {
  it("goes through everything where nobody else is here", () => {
    const { undo, sent, said } = setUp();
    undo.undo();
    undo.redo();
    undo.done(STROKE);
    expect([sent, said]).toEqual([["undo", "redo"], []]);
  });

  it("UD1: takes back what is one's own where others are here, and says what", () => {
    const { undo, sent, said } = setUp({ people: 2, canRedo: false });
    undo.undo();
    undo.done(STROKE);
    expect(undo.may("redo")).toBe(true);
    undo.redo();
    undo.done({ ...STROKE, away: false });
    expect([sent, said]).toEqual([
      ["take_back", "bring_back"],
      ["Undone: Stroke", "Redone: Stroke"],
    ]);
  });

  it("UD7: tells how much stays since others' wood stands on it", () => {
    const { undo, said } = setUp({ people: 2 });
    undo.done({ ...STROKE, held: 42 });
    undo.done({ ...STROKE, passed: 2 });
    expect(said).toEqual([
      "Undone: Stroke. 42 internodes stay, which bear what others drew.",
      "Undone: Stroke. Of what you did after it (2) nothing is left to undo.",
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
    expect(sent).toEqual(["undo", "redo"]);
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
    undo.refused({ kind: "undo" });
    undo.tapped(2);
    undo.forget();
    undo.done(STROKE);
    expect(said).toEqual([]);
  });
});
