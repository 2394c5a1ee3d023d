import { describe, expect, it } from "vitest";
import type { Command, Programme } from "../../../wire/generated";
import { grownUp, ProgrammeControl, valuesAt, withChanges } from "./programme-control";

const pine: Programme = {
  species: "scots-pine",
  parameters: { shedding_threshold: 0.25, max_shoot_length: 3 },
  stages: [
    { kind: "change", age: 0, parameters: { shedding_threshold: 0.9 } },
    { kind: "change", age: 10, parameters: {} },
  ],
  age: 23,
};

function control(age = 0) {
  const sent: Command[] = [];
  const state = { age, grownUp: 0 };
  const programmes = new ProgrammeControl({
    submit: (command) => sent.push(command),
    age: () => state.age,
    grownUp: () => {
      state.grownUp += 1;
    },
  });
  programmes.receive(pine, []);
  return { programmes, sent, state };
}

describe("a programme", () => {
  it("has the parameters of the stage that an age lies in", () => {
    expect([0, 9, 10, 99].map((age) => valuesAt(pine, age).shedding_threshold)).toEqual([0.9, 0.9, 0.25, 0.25]);
    expect(valuesAt(pine, 3).max_shoot_length).toBe(3);
  });

  it("shows a tree as it will be, with what is set by hand", () => {
    const young = valuesAt(pine, 2);
    expect(grownUp(pine, 2, young).shedding_threshold).toBe(0.25);
    expect(grownUp(pine, 2, { ...young, shedding_threshold: 0.6, leaf_size: 2 })).toEqual({
      ...valuesAt(pine, 23),
      shedding_threshold: 0.6,
      leaf_size: 2,
    });
  });

  it("keeps its stages in order when one is moved", () => {
    const [first, second] = [pine.stages[0]!, pine.stages[1]!];
    const stroke = { kind: "stroke", age: 12, samples: [] } as const;
    const drawn: Programme = { ...pine, stages: [first, second, stroke] as Programme["stages"] };
    const moved = withChanges(drawn, [first, { ...second, age: 12 }] as never);
    expect(moved.stages.map(({ kind, age }) => [kind, age])).toEqual([
      ["change", 0],
      ["change", 12],
      ["stroke", 12],
    ]);
  });
});

describe("growth by a programme", () => {
  it("ends where the tree is grown up, until it is asked for anew", () => {
    const { programmes, state } = control(20);
    const grow = (gesture: number): Command => ({ kind: "grow", steps: 2, gesture });
    expect(programmes.paced(grow(1))).toEqual({ ...grow(1), until: 23 });
    state.age = 23;
    expect(programmes.paced(grow(1))).toEqual({ ...grow(1), until: 23 });
    expect(programmes.paced(grow(1))).toEqual({ ...grow(1), until: 23 });
    expect(state.grownUp, "said once").toBe(1);
    expect(programmes.paced(grow(2))).toEqual(grow(2));
    expect(programmes.paced({ kind: "ungrow", steps: 2 })).toEqual({ kind: "ungrow", steps: 2 });
  });

  it("has no end without a programme", () => {
    const { programmes } = control();
    programmes.receive(null, []);
    expect(programmes.paced({ kind: "grow", steps: 2, gesture: 1 })).toEqual({ kind: "grow", steps: 2, gesture: 1 });
  });
});

describe("what is set by hand", () => {
  it("follows the programme where it is set to what the programme has", () => {
    const { programmes, state } = control(12);
    expect(programmes.setting({ shedding_threshold: 0.5 }).kind).toBe("set_parameters");
    expect(programmes.setting({ shedding_threshold: 0.25 })).toEqual({
      kind: "follow_programme",
      parameters: ["shedding_threshold"],
    });
    state.age = 3;
    expect(programmes.setting({ shedding_threshold: 0.25 }).kind).toBe("set_parameters");
    programmes.receive(null, []);
    expect(programmes.setting({ shedding_threshold: 0.25 }).kind).toBe("set_parameters");
  });
});
