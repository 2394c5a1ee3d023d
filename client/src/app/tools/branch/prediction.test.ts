import { describe, expect, it } from "vitest";
import { sampleTree } from "../../../../test/sample-tree";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { Command } from "../../../wire/generated";
import type { GhostFrame } from "../../../wire/ghost";
import { MOST_STEPS, Prediction } from "./prediction";

function setUp({ endsWithCommands = false } = {}) {
  const asked: [number[], number][] = [];
  const submitted: Command[] = [];
  const shown: (number | null)[] = [];
  const became: (number | null)[] = [];
  const said: string[] = [];
  const server = { there: true };
  const prediction: Prediction = new Prediction({
    cutsOf: (rows) => rows.filter((row) => row !== 1),
    predict: (rows, steps) => {
      if (server.there) {
        asked.push([rows, steps]);
      }
      return server.there;
    },
    submit: (command) => {
      // As the studio does with every command.
      if (endsWithCommands) {
        prediction.lost();
      }
      submitted.push(command);
    },
    newGesture: () => 77,
    show: (table: TreeTable) => shown.push(table.rows),
    end: (becoming: TreeTable | null) => {
      shown.push(null);
      became.push(becoming?.rows ?? null);
    },
    tell: (text) => said.push(text),
  });
  return { prediction, asked, submitted, shown, became, said, server };
}

const { changes } = sampleTree({ seed: 3, height: 6, orders: 2 });
const ghost = (sequence: number): GhostFrame => ({ epoch: 1, sequence, changes });
const nothing: GhostFrame = { epoch: 1, sequence: 9, changes: [] };

describe("a prediction", () => {
  it("shows the ghost the server grows", () => {
    const { prediction, asked, shown } = setUp();
    prediction.ask([5]);
    expect(asked).toEqual([[[5], 10]]);
    prediction.receive(ghost(1));
    expect(shown).toHaveLength(1);
    expect(shown[0]).toBeGreaterThan(5);
    expect(prediction.grown.peek()).toBe(10);
  });

  it("asks one question at a time, and then for what is wanted last", () => {
    const { prediction, asked } = setUp();
    prediction.ask([5]);
    for (const steps of [11, 15, 99]) {
      prediction.look(steps);
    }
    expect(asked).toHaveLength(1);
    prediction.receive(ghost(1));
    expect(asked.map(([, steps]) => steps)).toEqual([10, MOST_STEPS]);
    prediction.receive(ghost(2));
    expect(prediction.grown.peek()).toBe(MOST_STEPS);
    expect(asked).toHaveLength(2);
  });

  it("is kept as one operation that does what the ghost shows", () => {
    const { prediction, submitted, shown, became } = setUp();
    prediction.ask([5, 8]);
    prediction.keep();
    expect(submitted).toEqual([]);
    prediction.receive(ghost(1));
    prediction.look(12);
    prediction.keep();
    expect(submitted).toEqual([
      { kind: "prune", rows: [5, 8], gesture: 77 },
      { kind: "grow", steps: 10, gesture: 77 },
    ]);
    expect(shown[shown.length - 1]).toBeNull();
    expect(became, "the view goes to what the tree will be").toEqual([shown[0]]);
  });

  it("that is discarded leaves nothing", () => {
    const { prediction, asked, submitted, shown, became } = setUp();
    prediction.ask([5]);
    prediction.receive(ghost(1));
    prediction.discard();
    expect(asked[asked.length - 1]).toEqual([[], 0]);
    expect(submitted).toEqual([]);
    expect([shown[shown.length - 1], prediction.rows.peek(), became]).toEqual([null, null, [null]]);
    prediction.receive(ghost(2));
    expect(shown[shown.length - 1]).toBeNull();
  });

  it("ends when the server says so, but not while it is answering anew", () => {
    const { prediction } = setUp();
    prediction.ask([5]);
    prediction.receive(nothing);
    expect(prediction.rows.peek()).toEqual([5]);
    prediction.receive(ghost(1));
    prediction.receive(nothing);
    expect([prediction.rows.peek(), prediction.grown.peek()]).toEqual([null, null]);
  });

  it("of other branches takes the place of the one that is shown", () => {
    const { prediction, asked, became, submitted } = setUp();
    prediction.ask([5]);
    prediction.receive(ghost(1));
    prediction.ask([8]);
    expect([became, prediction.grown.peek()]).toEqual([[], null]);
    prediction.keep();
    expect(submitted, "nobody has seen it yet").toEqual([]);
    prediction.receive(ghost(2));
    expect(asked.map(([rows]) => rows)).toEqual([[5], [8]]);
    prediction.keep();
    expect(submitted[0]).toMatchObject({ rows: [8] });
  });

  it("PD2: ends with what else this client does, and may be asked anew", () => {
    const { prediction, asked, shown } = setUp();
    prediction.ask([5]);
    prediction.lost();
    expect([prediction.rows.peek(), prediction.grown.peek(), shown]).toEqual([null, null, []]);
    prediction.ask([8]);
    prediction.receive(ghost(1));
    prediction.look(12);
    prediction.lost();
    expect([prediction.rows.peek(), shown[shown.length - 1]]).toEqual([null, null]);
    prediction.receive(nothing);
    expect(asked).toEqual([
      [[5], 10],
      [[8], 10],
      [[8], 12],
    ]);
    prediction.ask([5]);
    prediction.receive(ghost(2));
    expect(prediction.grown.peek()).toBe(12);
  });

  it("that is kept is not ended by its own commands", () => {
    const { prediction, submitted, became } = setUp({ endsWithCommands: true });
    prediction.ask([5]);
    prediction.receive(ghost(1));
    prediction.keep();
    expect(submitted.map(({ kind }) => kind)).toEqual(["prune", "grow"]);
    expect(became).toHaveLength(1);
    expect(became[0], "the view goes to what the tree will be").not.toBeNull();
  });

  it("takes a refusal for its own only while a question is open", () => {
    const { prediction } = setUp();
    expect(prediction.refused()).toBe(false);
    prediction.ask([5]);
    expect(prediction.refused()).toBe(true);
    expect(prediction.rows.peek()).toBeNull();
  });

  it("does not ask what becomes of a tree without its trunk", () => {
    const { prediction, said, asked } = setUp();
    prediction.ask([1]);
    expect([asked, said.length, prediction.rows.peek()]).toEqual([[], 1, null]);
  });

  it("says when there is nobody to ask", () => {
    const { prediction, said, server } = setUp();
    server.there = false;
    prediction.ask([5]);
    expect(said).toHaveLength(1);
    expect(prediction.rows.peek()).toBeNull();
  });
});
