import { expect, it } from "vitest";
import type { Pointer } from "../../wire/generated";
import { POINTED_FOR, Pointing } from "./pointing";

/** What lies at each place of the canvas, as seen from a view: a row by x, and how often it was looked for. */
function glass() {
  const asked: number[] = [];
  const find = (x: number): Pointer | null => {
    asked.push(x);
    return x < 0 ? null : { kind: "wood", row: x, along: 0, offset: [0, 0, 0] };
  };
  return { asked, find };
}

it("PS1: what a pointer was put on is looked for once, and a mouse points to something else when the view moves", () => {
  const { asked, find } = glass();
  const pointing = new Pointing();
  expect(pointing.pointer("front", 0, find)).toBeNull();
  pointing.at(3, 0, false);
  expect(pointing.pointer("front", 0, find)).toMatchObject({ row: 3 });
  pointing.pointer("front", 99_999, find);
  expect(asked, "a mouse that rests goes on pointing").toEqual([3]);
  pointing.pointer("side", 99_999, find);
  expect(asked).toEqual([3, 3]);
  pointing.leave();
  expect(pointing.pointer("side", 99_999, find)).toBeNull();
});

it("PS1: a finger points to what it touched, however the view moves, and not for long once it has lifted", () => {
  const { asked, find } = glass();
  const pointing = new Pointing();
  pointing.at(3, 0, true);
  pointing.pointer("front", 0, find);
  pointing.lift(1000);
  expect(pointing.pointer("side", 1000 + POINTED_FOR, find)).toMatchObject({ row: 3 });
  expect(asked).toEqual([3]);
  expect(pointing.pointer("side", 1001 + POINTED_FOR, find)).toBeNull();
  pointing.at(4, 0, true);
  expect(pointing.pointer("side", 999_999, find), "until it touches again").toMatchObject({ row: 4 });
});

it("PS1: where there is nothing yet it is looked for again", () => {
  const { asked, find } = glass();
  const pointing = new Pointing();
  pointing.at(-1, 0, true);
  pointing.pointer("front", 0, find);
  pointing.pointer("front", 0, find);
  expect(asked).toEqual([-1, -1]);
});
