import { expect, it } from "vitest";
import {
  asked,
  type Candidate,
  candidates,
  completed,
  labelOf,
  matching,
  mentionedIn,
  mentionsOf,
  piecesOf,
} from "./mentions";

const NAMES = ["Ann", "Anna Lee", "Bo", "Émile"];

it.each([
  ["@", 1, ""],
  ["hello @an", 9, "an"],
  ["hello @an and more", 9, "an"],
  ["(@Anna L", 8, "Anna L"],
  ["me@work", 7, null],
  ["hello @an\nnext", 14, null],
  ["hello", 5, null],
])("CT1: %j with the caret at %i asks for %j", (text, caret, expected) => {
  expect(asked(text, caret)).toBe(expected);
});

it.each([
  ["", NAMES],
  ["an", ["Ann", "Anna Lee"]],
  ["lee", ["Anna Lee"]],
  ["emi", ["Émile"]],
  ["bo", []],
  ["x", []],
])("CT1: %j may become %j", (typed, expected) => {
  const all = candidates([], NAMES);
  expect(matching(all, typed).map(({ name }) => name)).toEqual(expected);
});

it("CT1: a name takes the place of what was typed of it, and the caret stands behind it", () => {
  expect(completed("see @an", 7, "Anna Lee")).toEqual({ text: "see @Anna Lee ", caret: 14 });
  expect(completed("@b please", 2, "Bo")).toEqual({ text: "@Bo please", caret: 4 });
});

it("CT1: a text is told apart in mentions and what is between", () => {
  expect(piecesOf("@Ann, ask @anna lee or @Bob; bo@Ann.org", NAMES)).toEqual([
    { text: "@Ann", name: "Ann" },
    { text: ", ask ", name: null },
    { text: "@anna lee", name: "Anna Lee" },
    { text: " or @Bob; bo@Ann.org", name: null },
  ]);
  expect(piecesOf("nobody", NAMES)).toEqual([{ text: "nobody", name: null }]);
  expect(mentionedIn("@Bo and @bo and @Ann", NAMES)).toEqual(["Bo", "Ann"]);
});

const HERE: Candidate[] = [
  { name: "Bo", person: 2 },
  { name: "bo", person: 5 },
  { name: "Ann", person: 3 },
  { name: "Ann", person: 3 },
];

it("CT7: two of one name are told apart, and one at two devices is one", () => {
  const all = candidates(HERE, ["Ann", "Cy"]);
  expect(all).toEqual([...HERE.slice(0, 3), { name: "Cy", person: null }]);
  expect(all.map((one) => labelOf(one, all))).toEqual(["Bo (2)", "bo (5)", "Ann", "Cy"]);
});

it("CT7: who was picked from the list is meant by the name, and who alone has it", () => {
  const all = candidates(HERE, ["Cy"]);
  const [first, second] = HERE as [Candidate, Candidate];
  expect(mentionsOf("@Bo and @Ann and @Cy", all, [], [first, second])).toEqual([
    { name: "bo", person: 5 },
    { name: "Ann", person: 3 },
    { name: "Cy" },
  ]);
  expect(mentionsOf("@Bo", all, [], [])).toEqual([{ name: "Bo" }]);
  expect(mentionsOf("@Bo", all, [first], [second])).toEqual([{ name: "Bo", person: 2 }]);
  expect(mentionsOf("nobody", all, [], [second])).toEqual([]);
});
