import { expect, it } from "vitest";
import { asked, completed, matching, mentionedIn, piecesOf } from "./mentions";

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
  expect(matching(NAMES, typed)).toEqual(expected);
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
