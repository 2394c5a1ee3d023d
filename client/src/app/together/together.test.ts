import { describe, expect, it } from "vitest";
import type { Person } from "../../wire/generated";
import { authorName } from "../document/timeline/authors";
import { Together } from "./together";

/** A page that has met Ann, who is here, and Bo, who has left. */
function met(): Together {
  const together = new Together();
  const person = (number: number, name: string): Person => ({ person: number, name, role: "editor", devices: [] });
  together.meet({ type: "people", you: 10, people: [person(1, "Ann"), person(2, "Bo")], more: 0 });
  together.meet({ type: "people", you: 10, people: [person(1, "Ann")], more: 0 });
  return together;
}

const names = (together: Together) => [1, 2].map((number) => authorName(number, together));

describe("who did what on the line of time", () => {
  it("PS3: is known by name also while the link is lost", () => {
    const together = met();
    together.lost();
    expect(names(together)).toEqual(["Ann", "Bo"]);
    expect(together.people.value).toBeNull();
  });

  it("PS4: whose camera a page follows stays as long as numbers do", () => {
    const together = met();
    together.followed.value = 11;
    together.lost();
    expect(together.followed.value).toBe(11);
    together.renumbered();
    expect(together.followed.value).toBeNull();
  });

  it("RS2, PS3: is nobody whom the page met, once people have other numbers or another session is open", () => {
    const renumbered = met();
    renumbered.lost();
    renumbered.renumbered();
    expect(names(renumbered)).toEqual(["Person 1", "Person 2"]);
    const another = met();
    another.forget();
    expect(names(another)).toEqual(["Person 1", "Person 2"]);
  });
});
