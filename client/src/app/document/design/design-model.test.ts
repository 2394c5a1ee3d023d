import { describe, expect, it } from "vitest";
import type { Command, DesignInForce, PlacedBranch } from "../../../wire/generated";
import { DesignEditing } from "./design-editing";
import { DESIGN_KEYS } from "./design-keys";
import { bearerOf, DesignModel, type KeyName, wayTo } from "./design-model";
import { DesignSignal } from "./design-signal";

function told(graph: unknown, stepsOnTop = 0): DesignInForce {
  const laterals = { "/": [0, 1, 2], "/1": [0, 1] };
  return { at: [0, 0, 0], graph, values: 0, branches: 6, laterals, asleep: [], steps_on_top: stepsOnTop, row: 0 };
}

function keyOf(name: KeyName) {
  const found = DESIGN_KEYS.find((key) => key.name === name);
  if (!found) {
    throw new Error(`no ${name}`);
  }
  return found;
}

const GRAPH = {
  nodes: {
    "/": {
      values: {
        roll: { own: 10 },
        density: {
          own: [
            [0, 4],
            [1, 8],
          ],
        },
      },
    },
    "/1": { name: "left", values: { roll: { own: 30, private: true }, reach: { shared: 2 } } },
    "/1/0": {
      values: {
        roll: { add: 5 },
        density: {
          multiply: [
            [0, 0.5],
            [1, 0.5],
          ],
        },
      },
    },
    "/2": { values: { roll: { inherited: true, below: true } } },
  },
  levels: { "2": { values: { girth: { own: 0.3 } } } },
  shares: { "2": { key: "reach", value: 1.5 } },
};

describe("a design on the page", () => {
  const model = new DesignModel(told(GRAPH));
  const value = (path: string, key: KeyName) => model.resolve(path, keyOf(key));

  it("takes values from the first public branch below", () => {
    expect(value("/0", "roll")).toMatchObject({ value: 10, status: "inherited", origin: "/" });
    expect(value("/1", "roll")).toMatchObject({ value: 30, status: "own", isPrivate: true, origin: "/1" });
    // What limb 1 keeps to itself its branches do not have.
    expect(value("/1/0", "roll")).toMatchObject({ value: 15, inherited: 10, status: "offset" });
    expect(value("/1/1", "roll")).toMatchObject({ value: 10, origin: "/" });
  });

  it("knows shared values, levels, functions and defaults", () => {
    expect(value("/1", "reach")).toMatchObject({ value: 1.5, status: "shared" });
    expect(value("/1/0", "reach")).toMatchObject({ value: 1.5, status: "inherited", origin: "/1" });
    expect(value("/1/1", "girth")).toMatchObject({ value: 0.3, origin: "level 2" });
    expect(value("/1/0", "density").value).toEqual([
      [0, 2],
      [1, 4],
    ]);
    expect(value("/0", "orders")).toMatchObject({ value: 3, origin: null });
  });

  it("takes a value from beneath on the same axis where that is said", () => {
    // Limb 1 keeps its own, so it is that of limb 0, which inherits from the plant.
    expect(value("/2", "roll")).toMatchObject({ value: 10, status: "inherited" });
  });

  it("knows the way to a branch", () => {
    expect(wayTo("/1/0")).toEqual(["/", "/1", "/1/0"]);
    expect(bearerOf("/")).toBe(null);
  });
});

describe("editing a design", () => {
  function editing(graph: unknown = GRAPH, stepsOnTop = 0) {
    const sent: Command[] = [];
    const design = new DesignSignal();
    design.receive(told(graph, stepsOnTop));
    let now = 0;
    const of = new DesignEditing({
      design,
      submit: (command) => sent.push(command),
      newGesture: () => 7,
      now: () => {
        now += 20;
        return now;
      },
      unsettled: () => 0,
      later: () => {},
    });
    return { of, sent, design };
  }

  it("sends all of one movement as one gesture, not too often", () => {
    const { of, sent } = editing();
    of.choose("/1");
    for (const roll of [1, 2, 3, 4]) {
      of.drag(keyOf("roll"), roll);
    }
    of.commit(keyOf("roll"), 5);
    of.commit(keyOf("roll"), 6);
    expect(sent.length).toBeLessThan(6);
    expect(sent.slice(0, -1).every((command) => command.gesture === 7)).toBe(true);
    expect(sent.at(-1)).toEqual({
      kind: "edit_design",
      edits: [{ edit: "set", of: "/1", key: "roll", value: { own: 6, private: true } }],
    });
  });

  it("DS10: shows a tree that was described once its design stands, and not before", () => {
    const { of, sent, design } = editing(GRAPH, 3);
    of.choose("/1");
    of.describe(0);
    expect(sent).toEqual([{ kind: "fit_design", row: 0 }]);
    // The one in force is told again meanwhile; perhaps it was fitted as well.
    design.receive({ ...told(GRAPH, 3), overlap: 0.9 });
    expect([of.isDescribed(), of.begun.value, of.chosen.value]).toEqual([false, 0, "/1"]);
    design.receive({ ...told(GRAPH), overlap: 0.9, row: 40 });
    expect(of.isDescribed()).toBe(true);
    of.showDescribed();
    expect([of.isDescribed(), of.begun.value, of.chosen.value]).toEqual([false, 1, "/"]);
  });

  it("keeps relative values relative and shared ones shared", () => {
    const { of, sent } = editing();
    of.choose("/1/0");
    of.commit(keyOf("roll"), 8);
    of.choose("/1");
    of.commit(keyOf("reach"), 1.2);
    expect(sent.map((command) => (command.kind === "edit_design" ? command.edits[0] : null))).toEqual([
      { edit: "set", of: "/1/0", key: "roll", value: { add: 8 } },
      { edit: "set_shared", share: 2, value: 1.2 },
    ]);
  });

  it("says a value in another way as near to what it was as can be, and not the same way twice", () => {
    const { of, sent } = editing();
    of.choose("/1/0");
    // It has 15, of which 10 are inherited.
    of.say(keyOf("roll"), "offset");
    of.say(keyOf("roll"), "factor");
    of.say(keyOf("density"), "factor");
    of.say(keyOf("density"), "offset");
    of.choose("/1");
    of.say(keyOf("roll"), "offset");
    of.say(keyOf("density"), "factor");
    const line = (base: number, tip: number) => [
      [0, base],
      [1, tip],
    ];
    expect(sent.map((command) => (command.kind === "edit_design" ? command.edits[0] : null))).toEqual([
      { edit: "set", of: "/1/0", key: "roll", value: { multiply: 1.5 } },
      { edit: "set", of: "/1/0", key: "density", value: { add: line(-2, -4) } },
      { edit: "set", of: "/1", key: "roll", value: { add: 20, private: true } },
      { edit: "set", of: "/1", key: "density", value: { multiply: line(1, 1) } },
    ]);
  });

  it("gives a value to the bearer, and shares one among siblings", () => {
    const { of, sent } = editing();
    of.choose("/1");
    of.promote(keyOf("roll"));
    of.say(keyOf("girth"), "shared");
    expect(sent.map((command) => (command.kind === "edit_design" ? command.edits : null))).toEqual([
      [
        { edit: "set", of: "/", key: "roll", value: { own: 30 } },
        { edit: "clear", of: "/1", key: "roll" },
      ],
      [{ edit: "share", share: 3, key: "girth", value: 0.55, members: ["/0", "/1", "/2"] }],
    ]);
  });

  it("inherits along the axis, and changes what is said so without forgetting it", () => {
    const { of, sent } = editing();
    of.choose("/1/0");
    of.inheritBelow(keyOf("roll"), true);
    of.choose("/2");
    of.inheritBelow(keyOf("roll"), false);
    const level = editing({ levels: { "1": { values: { roll: { add: 6, below: true } } } } });
    level.of.choose("/2");
    level.of.commit(keyOf("roll"), 9);
    expect(
      [...sent, ...level.sent].map((command) => (command.kind === "edit_design" ? command.edits[0] : null)),
    ).toEqual([
      { edit: "set", of: "/1/0", key: "roll", value: { add: 5, below: true } },
      { edit: "clear", of: "/2", key: "roll" },
      { edit: "set", of: "/2", key: "roll", value: { add: 9, below: true } },
    ]);
  });

  it("knows branches far up once they are on the way to the one that is looked at", () => {
    const { of, design } = editing();
    expect([of.laterals("/1"), of.laterals("/1/0")]).toEqual([["/1/0", "/1/1"], null]);
    const branch = (path: string, at: number) => ({ path, at }) as PlacedBranch;
    design.placed.value = { of: "/1/0", branches: [branch("/1/0/3", 0.7), branch("/1/0/1", 0.2), branch("/1/1", 0.5)] };
    expect([of.laterals("/1/0"), of.laterals("/1/1")]).toEqual([["/1/0/1", "/1/0/3"], null]);
  });

  it("says values of all branches of an order, and lets those follow that have their own", () => {
    const graph = {
      nodes: { "/1": { values: { reach: { own: 2 } } }, "/0": { values: { roll: { own: 1 } } } },
      levels: { "1": { values: { girth: { add: 0.1 } } } },
    };
    const { of, sent } = editing(graph);
    of.choose("/");
    of.speakOf("order");
    // The plant as a whole is the only one of its order.
    expect(of.scope.value).toBe("branch");
    of.choose("/1");
    expect(of.model.value?.resolve("/1", keyOf("reach"), "order")).toMatchObject({ value: 1, status: "inherited" });
    of.commit(keyOf("reach"), 0.8);
    of.commit(keyOf("girth"), 0.2);
    of.say(keyOf("zone"), "own");
    of.hide(keyOf("girth"), true);
    of.follow("reach", of.model.value?.exceptions(1, "reach") ?? []);
    // What a hand shapes holds for all, and for the one that it shaped.
    of.shaped({ kind: "value", key: "reach", value: 0.5, isPrivate: true });
    expect(sent.map((command) => (command.kind === "edit_design" ? command.edits : null))).toEqual([
      [{ edit: "set", of: "level 1", key: "reach", value: { own: 0.8 } }],
      [{ edit: "set", of: "level 1", key: "girth", value: { add: 0.2 } }],
      [{ edit: "set", of: "level 1", key: "zone", value: { own: [0.15, 0.95] } }],
      [{ edit: "set", of: "level 1", key: "girth", value: { add: 0.1, private: true } }],
      [{ edit: "clear", of: "/1", key: "reach" }],
      [
        { edit: "set", of: "level 1", key: "reach", value: { own: 0.5 } },
        { edit: "clear", of: "/1", key: "reach" },
      ],
    ]);
  });

  it("puts a template in the place of a design that is open, and beside one that rests", () => {
    const open = editing();
    open.of.begin("chokkan");
    expect(open.sent).toEqual([{ kind: "new_design", template: "chokkan" }]);
    const sealed = editing(GRAPH, 3);
    sealed.of.begin("chokkan");
    expect(sealed.sent).toEqual([{ kind: "new_design", template: "chokkan", position: [0, 0, 0] }]);
  });
});
