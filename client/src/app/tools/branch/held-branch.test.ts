import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { GhostPlacement } from "../../../scene/overlay/ghost";
import type { Command } from "../../../wire/generated";
import { about, type Rotation, turned } from "./branch-turn";
import { HeldBranch, type TurnPreview } from "./held-branch";

/** A trunk of four metamers (1 to 4), a limb to the right on 2 (5 to 7) with a twig on 6 (8). */
function tree() {
  const parent = [-1, 0, 1, 2, 3, 2, 5, 6, 6];
  const startsAxis = [0, 1, 0, 0, 0, 1, 0, 0, 1];
  const position = [
    [0, 0, 0],
    [0, 1, 0],
    [0, 2, 0],
    [0, 3, 0],
    [0, 4, 0],
    [1, 2, 0],
    [2, 2, 0],
    [3, 2, 0],
    [2, 3, 0],
  ].flat();
  return { rows: 9, parent, startsAxis, radiusCode: parent.map((below) => (below < 0 ? 0 : 100)), position };
}

function setUp() {
  const rows = tree();
  const sent: Command[] = [];
  const turns: (TurnPreview | null)[] = [];
  const copies: (GhostPlacement | null)[] = [];
  let gesture = 40;
  const world = { busy: false };
  const held = new HeldBranch({
    rows,
    submit: (command) => sent.push(command),
    newGesture: () => {
      gesture += 1;
      return gesture;
    },
    busy: () => world.busy,
    branchAbove: (row) => (row === 5 ? [5, 6, 7, 8] : [row]),
    showTurn: (turn) => turns.push(turn),
    showCopy: (_, placement) => copies.push(placement),
  });
  const last = <Kind extends Command["kind"]>(kind: Kind) => {
    const command = sent[sent.length - 1];
    if (command?.kind !== kind) {
      throw new Error(`the last command is no ${kind}`);
    }
    return command as Extract<Command, { kind: Kind }>;
  };
  return { world, held, rows, sent, turns, copies, last };
}

const screen = { right: [1, 0, 0], up: [0, 1, 0] } as const;
const near = (actual: readonly number[], wanted: readonly number[]) => {
  for (const [i, value] of wanted.entries()) {
    expect(actual[i]).toBeCloseTo(value, 6);
  }
};

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

describe("taking a branch", () => {
  it("takes the whole axis first, then what is above the place", () => {
    const { held } = setUp();
    expect(held.take(7)).toBe(true);
    expect(held.row.peek()).toBe(5);
    held.take(6);
    expect(held.row.peek()).toBe(6);
    held.take(6);
    expect(held.row.peek()).toBe(5);
  });

  it("takes a trunk only from the place up, and never as a whole", () => {
    const { held } = setUp();
    held.take(3);
    expect(held.row.peek()).toBe(3);
    held.release();
    expect(held.take(1)).toBe(false);
    expect(held.row.peek()).toBeNull();
  });

  it("knows what is part of it, and where it stands", () => {
    const { held } = setUp();
    held.take(5);
    expect([8, 7, 5, 4, 2].map((row) => held.holds(row))).toEqual([true, true, true, false, false]);
    expect(held.base()).toEqual([0, 2, 0]);
    expect(held.heading()).toEqual([1, 0, 0]);
  });

  it("lets go of a branch that someone has cut", () => {
    const { held, rows } = setUp();
    held.take(5);
    expect(held.keep()).toBe(true);
    rows.radiusCode[5] = 0;
    expect(held.keep()).toBe(false);
    expect(held.row.peek()).toBeNull();
  });
});

describe("turning", () => {
  const quarter = about([0, 0, 1], Math.PI / 2);

  it("is one command when the held lets go", () => {
    const { held, sent, turns, last } = setUp();
    held.take(5);
    held.beginTurn();
    held.turn(about([0, 0, 1], 0.4));
    held.turn(quarter);
    expect(sent).toEqual([]);
    expect(turns[turns.length - 1]).toEqual({ row: 5, rotation: quarter, about: [0, 2, 0] });
    held.endTurn();
    expect(last("turn_branch")).toEqual({ kind: "turn_branch", row: 5, rotation: [...quarter], gesture: 41 });
  });

  it("stays shown until the rows have it", () => {
    const { held, rows, turns } = setUp();
    held.take(5);
    held.beginTurn();
    held.turn(quarter);
    held.endTurn();
    held.keep();
    expect(turns[turns.length - 1]).not.toBeNull();
    rows.position.splice(15, 3, 0, 3, 0);
    held.keep();
    expect(turns[turns.length - 1]).toBeNull();
    expect(held.row.peek()).toBe(5);
  });

  it("that is refused or forgotten goes back", () => {
    for (const end of ["refused", "time"] as const) {
      const { held, turns } = setUp();
      held.take(5);
      held.beginTurn();
      held.turn(quarter);
      held.endTurn();
      end === "refused" ? held.refused() : vi.advanceTimersByTime(10_000);
      expect(turns[turns.length - 1]).toBeNull();
    }
  });

  it("stays where it was turned to while the server has something else to grow first", () => {
    const { held, turns, world } = setUp();
    held.take(5);
    held.beginTurn();
    held.turn(quarter);
    held.endTurn();
    world.busy = true;
    vi.advanceTimersByTime(60_000);
    expect(turns[turns.length - 1]).not.toBeNull();
    world.busy = false;
    vi.advanceTimersByTime(10_000);
    expect(turns[turns.length - 1]).toBeNull();
  });

  it("by a hair is none, and a cancelled one neither", () => {
    const { held, sent } = setUp();
    held.take(5);
    held.beginTurn();
    held.turn(about([0, 0, 1], 0.001));
    held.endTurn();
    held.beginTurn();
    held.turn(quarter);
    held.cancelTurn();
    held.endTurn();
    expect(sent).toEqual([]);
  });

  it("BR1: in steps of keys counts from before the first", () => {
    const { held, last } = setUp();
    held.take(5);
    held.step(-1, 0, 0, screen, 0);
    const first = last("turn_branch");
    held.step(-1, 0, 0, screen, 200);
    const second = last("turn_branch");
    expect(second.gesture).toBe(first.gesture);
    near(turned(second.rotation as Rotation, [1, 0, 0]), [Math.cos(Math.PI / 18), Math.sin(Math.PI / 18), 0]);
    held.step(-1, 0, 0, screen, 9000);
    expect(last("turn_branch").gesture).not.toBe(first.gesture);
    near(last("turn_branch").rotation, first.rotation);
  });

  it("about itself leaves where it points", () => {
    const { held, last } = setUp();
    held.take(5);
    held.step(0, 0, 1, screen, 0);
    near(turned(last("turn_branch").rotation as Rotation, [1, 0, 0]), [1, 0, 0]);
  });
});

describe("grafting", () => {
  it("stands to the new limb as it stood to the old one", () => {
    const { held, copies, last } = setUp();
    held.take(8);
    held.beginPlacing("copy");
    held.showOn(4, null);
    // The twig stood upright on a limb that goes to the right; on the trunk, which goes up, it points to the left.
    const placement = copies[copies.length - 1];
    expect(placement?.from).toEqual([2, 2, 0]);
    expect(placement?.to).toEqual([0, 4, 0]);
    near(turned(placement?.turn ?? [0, 0, 0, 1], [0, 1, 0]), [-1, 0, 0]);
    expect(held.graft()).toBe(true);
    expect(last("graft")).toMatchObject({ row: 8, onto: 4, keep: true });
    near(last("graft").rotation, placement?.turn ?? []);
  });

  it("points where the finger is", () => {
    const { held, copies } = setUp();
    held.take(5);
    held.beginPlacing("move");
    held.showOn(4, [0, 4, 9]);
    // Its furthest end lies at the right of its base.
    near(turned(copies[copies.length - 1]?.turn ?? [0, 0, 0, 1], [1, 0, 0]), [0, 0, 1]);
  });

  it("BR2: sets no branch on itself, nor a copy of it", () => {
    const { held } = setUp();
    held.take(5);
    for (const mode of ["move", "copy"] as const) {
      held.beginPlacing(mode);
      expect([5, 7, 8, 2, 4].map((row) => held.mayBear(row))).toEqual([false, false, false, true, true]);
    }
  });

  it("needs a limb", () => {
    const { held, sent } = setUp();
    held.take(5);
    held.beginPlacing("move");
    held.showAt([5, 5, 0]);
    expect(held.graft()).toBe(false);
    expect(sent).toEqual([]);
    expect(held.placing.peek()).toBe("move");
  });

  it("shows the copy until its rows have come, and then holds them", () => {
    const { held, rows, copies } = setUp();
    held.take(5);
    held.beginPlacing("move");
    held.showOn(4, null);
    held.graft();
    held.keep();
    held.hide();
    expect(copies[copies.length - 1]).not.toBeNull();
    rows.rows = 10;
    rows.parent.push(4);
    rows.startsAxis.push(1);
    rows.radiusCode.push(100);
    rows.radiusCode[5] = 0;
    rows.position.push(1, 5, 0);
    expect(held.keep()).toBe(true);
    expect(copies[copies.length - 1]).toBeNull();
    expect(held.row.peek()).toBe(9);
  });
});
