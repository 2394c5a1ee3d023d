import { describe, expect, it } from "vitest";
import { countHere } from "./count-here";
import { changesOf, companions, followersOf, isFollowed, isReplaying } from "./people";
import type { PeopleHere } from "./together";

const HERE: PeopleHere = {
  type: "people",
  you: 1,
  more: 0,
  people: [
    {
      person: 1,
      role: "owner",
      name: "Ann",
      devices: [
        { device: 1, state: "here" },
        { device: 4, state: "away" },
      ],
    },
    { person: 2, role: "editor", devices: [{ device: 2, state: "here", follows: 1 }] },
  ],
};

describe("people", () => {
  it("PS3: one's own other device is a companion, this one is not", () => {
    expect(companions(HERE).map(({ device, name }) => [device.device, name])).toEqual([
      [2, "Person 2"],
      [4, "Ann"],
    ]);
    expect(companions(null)).toEqual([]);
  });

  it("PS3: who has two pages counts once, who does not answer not at all, and pages where nobody knows more", () => {
    const asleep = { ...HERE.people[1]!, devices: [{ device: 2, state: "gone" as const }] };
    expect(countHere(HERE, 3)).toBe(2);
    expect(countHere({ ...HERE, people: [HERE.people[0]!, asleep] }, 3)).toBe(1);
    expect(countHere({ ...HERE, more: 5 }, 8)).toBe(8);
    expect(countHere(null, 3)).toBe(3);
  });

  it("PS4: a page knows that it is followed", () => {
    expect([isFollowed(HERE), isFollowed({ ...HERE, you: 2 }), isFollowed(null)]).toEqual([true, false, false]);
  });

  it("PS4: and by whom, but for its own other devices' follow of somebody else", () => {
    expect(followersOf(HERE).map(({ person }) => person)).toEqual([2]);
    expect(followersOf({ ...HERE, you: 4 })).toEqual([]);
  });

  it("PS3: a device plays the design as long as it answers", () => {
    const device = { device: 2, tool: "replay" };
    expect((["here", "away", "gone"] as const).map((state) => isReplaying({ ...device, state }))).toEqual([
      true,
      true,
      false,
    ]);
    expect(isReplaying({ device: 2, tool: "brush", state: "here" })).toBe(false);
  });

  it("has come or left who has no device or the first one", () => {
    const alone = { ...HERE, people: HERE.people.slice(0, 1) };
    expect(changesOf(alone, HERE).came.map(({ person }) => person)).toEqual([2]);
    expect(changesOf(HERE, alone).left.map(({ person }) => person)).toEqual([2]);
    const phone = { ...HERE, people: [{ ...HERE.people[0]!, devices: [{ device: 4, state: "here" as const }] }] };
    expect(changesOf(alone, phone)).toEqual({ came: [], left: [] });
  });
});
