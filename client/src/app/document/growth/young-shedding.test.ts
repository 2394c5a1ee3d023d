import { describe, expect, it } from "vitest";
import type { Programme } from "../../../wire/generated";
import { valuesAt } from "./programme-control";
import { youngShedding } from "./young-shedding";

const pine: Programme = {
  parameters: { shedding_threshold: 0.25 },
  stages: [
    { kind: "change", age: 0, parameters: { shedding_threshold: 0.9 } },
    { kind: "change", age: 4, parameters: { shedding_threshold: 0.8 } },
    { kind: "change", age: 10, parameters: {} },
  ],
  age: 23,
};
const follows = { programme: pine, byHand: [] };

describe("a young stage that sheds", () => {
  it("lasts until the first stage that keeps branches", () => {
    for (const age of [0, 3, 4, 9]) {
      expect(youngShedding(follows, age, valuesAt(pine, age)), `age ${age}`).toEqual({ until: 10, later: 0.25 });
    }
    expect(youngShedding(follows, 10, valuesAt(pine, 10))).toBeNull();
  });

  it("sheds nothing where the threshold was set by hand", () => {
    const byHand = { programme: pine, byHand: ["shedding_threshold"] as const };
    expect(youngShedding(byHand, 2, { ...valuesAt(pine, 2), shedding_threshold: 0.25 })).toBeNull();
    expect(youngShedding(byHand, 2, valuesAt(pine, 2)), "that is what somebody wants").toBeNull();
  });

  it("is none where every stage sheds alike", () => {
    const strict: Programme = { parameters: { shedding_threshold: 0.9 }, stages: [], age: 20 };
    expect(youngShedding({ programme: strict, byHand: [] }, 2, valuesAt(strict, 2))).toBeNull();
  });
});
