import { expect, it } from "vitest";
import { growthAhead } from "./growth-ahead";

it.each([
  ["without a document nothing is ahead", null, true, 0, 0],
  ["the server's count is taken", { step: 7, pending_steps: 3 }, false, 7, 3],
  ["LA1: an outline may take more steps than are announced", { step: 7, pending_steps: 3 }, true, 7, 400],
  ["DS10: trials of a design are one step", { step: 7, pending_steps: 90, trials: 80 }, false, 7, 11],
  ["and has none left once it is done", { step: 9, pending_steps: 0 }, true, 9, 0],
])("%s", (_, document, growsOutline, step, pending) => {
  expect(growthAhead(document, growsOutline)).toEqual({ step, pending });
});
