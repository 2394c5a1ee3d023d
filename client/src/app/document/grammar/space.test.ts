import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Command, GrammarBody, GrammarInForce } from "../../../wire/generated";
import { OutlineTrace } from "../../tools/lasso/outline-trace";
import type { ToolName } from "../../tools/tools";
import { GrammarSpace, outlineOf, surrounds } from "./space";
import { asksSpace } from "./typed";

const body: GrammarBody = {
  outline: [
    [-4, -1],
    [4, -1],
    [4, 9],
    [-4, 9],
  ],
  plane: { origin: [10, 0, 3], right: [0, 0, -1], up: [0, 1, 0] },
};

function setUp() {
  const inForce = signal({ at: [10, 0, 3], within: null } as unknown as GrammarInForce | null);
  const outline = new OutlineTrace();
  const chosen = signal<ToolName>("brush");
  const sent: Command[] = [];
  const space = new GrammarSpace({
    inForce,
    outline,
    chosen,
    choose: (tool) => {
      chosen.value = tool;
    },
    submit: (command) => sent.push(command),
  });
  return { inForce, outline, chosen, sent, space };
}

describe("the space of a grammar", () => {
  it("is the next outline, and the tool of before is taken up again", () => {
    const { outline, chosen, sent, space } = setUp();
    space.draw();
    expect([space.drawing.value, chosen.value]).toEqual([true, "lasso"]);
    expect(outline.taker?.through).toEqual([10, 0, 3]);
    outline.taker?.take(body);
    expect(sent).toEqual([{ kind: "set_grammar_body", within: body }]);
    expect([space.drawing.value, chosen.value, outline.taker]).toEqual([false, "brush", null]);
    space.clear();
    expect(sent[1]).toEqual({ kind: "set_grammar_body" });
  });

  it("is waited for no more once another tool is taken, or it is given up, or the grammar has gone", () => {
    const { inForce, outline, chosen, sent, space } = setUp();
    space.draw();
    chosen.value = "prune";
    expect([space.drawing.value, chosen.value, outline.taker]).toEqual([false, "prune", null]);
    space.draw();
    space.stop();
    expect([space.drawing.value, chosen.value]).toEqual([false, "prune"]);
    space.draw();
    inForce.value = null;
    expect([space.drawing.value, chosen.value, sent]).toEqual([false, "prune", []]);
    space.draw();
    expect(space.drawing.value).toBe(false);
  });

  it("knows its places in the world, and whether the seed stands in it", () => {
    expect(outlineOf(body)[2]).toEqual([10, 9, -1]);
    expect(surrounds(body, [10, 0, 3])).toBe(true);
    expect(surrounds(body, [10, 0, 8])).toBe(false);
    expect(surrounds(body, [10, -2, 3])).toBe(false);
  });

  it("is asked for by a text or not", () => {
    expect(asksSpace("A : inside( 0 ) --> F")).toBe(true);
    expect(asksSpace("A : exists(0) --> F")).toBe(true);
    expect(asksSpace("A : inside(1) --> F")).toBe(false);
  });
});
