import { describe, expect, it } from "vitest";
import { Virtual } from "../../../../test/virtual-clock";
import { type Appearance, type AppearancePatch, DEFAULT_APPEARANCE } from "../../../wire/generated";
import { LookDraft } from "./look-draft";
import { patched } from "./look-numbers";

/** A server that two people share, whose answers come when they are asked for. */
function shared() {
  const clock = new Virtual();
  let looks: Appearance = DEFAULT_APPEARANCE;
  const underWay: { readonly patch: AppearancePatch; readonly person: number; readonly command: number }[] = [];
  const people = [0, 1].map((person) => {
    let command = 0;
    return new LookDraft({
      submit: (patch) => {
        command += 1;
        underWay.push({ patch, person, command });
        return command;
      },
      newGesture: () => command + 1,
      ahead: () => ({ step: 0, pending: 0 }),
      clock,
    });
  });
  const [ann, ben] = people as [LookDraft, LookDraft];
  return {
    clock,
    ann,
    ben,
    sent: underWay,
    looks: () => looks,
    /** All commands arrive, and every client gets the new value. */
    arrive: () => {
      for (const { patch, person, command } of underWay.splice(0)) {
        looks = patched(looks, patch);
        people[person]?.settle(command);
      }
      for (const draft of people) draft.receive(looks);
    },
  };
}

describe("draft of looks", () => {
  it("AP1: only the field that is set is sent", () => {
    const { ann, sent } = shared();
    ann.commit({ leaves: { season: 2 } });
    expect(sent.map(({ patch }) => patch)).toEqual([{ leaves: { season: 2 } }]);
    expect(ann.value.value).toEqual(patched(DEFAULT_APPEARANCE, { leaves: { season: 2 } }));
  });

  it("two who drag in one section both get what they set", () => {
    const { ann, ben, clock, looks, arrive } = shared();
    for (let i = 1; i <= 5; i++) {
      ann.drag({ leaves: { season: 1 + i / 5 } });
      ben.drag({ leaves: { tint: [40 * i, 0, 0] } });
      clock.pass(70);
      if (i % 2 === 0) arrive();
      expect(ann.value.value.leaves.season, "the user's own counts").toBe(1 + i / 5);
      expect(ben.value.value.leaves.tint).toEqual([40 * i, 0, 0]);
    }
    ann.commit({ leaves: { season: 2 } });
    ben.commit({ leaves: { tint: [200, 0, 0] } });
    arrive();
    clock.pass(2000);
    const both = patched(DEFAULT_APPEARANCE, { leaves: { season: 2, tint: [200, 0, 0] } });
    expect(looks()).toEqual(both);
    expect([ann, ben].map((draft) => draft.value.value)).toEqual([both, both]);
  });

  it("sections that are set whole arrive whole", () => {
    const { ann, ben, arrive } = shared();
    const bark = { ...DEFAULT_APPEARANCE.bark, kind: "papery" as const, relief: 0.2 };
    ann.commit({ bark });
    arrive();
    expect(ben.value.value).toEqual({ ...DEFAULT_APPEARANCE, bark });
  });
});
