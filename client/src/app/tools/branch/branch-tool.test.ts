import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../../scene/vector";
import type { Command } from "../../../wire/generated";
import { BranchTool } from "./branch-tool";
import { type Rotation, turned } from "./branch-turn";
import { HeldBranch } from "./held-branch";

const SLOP = 9;
/** Pixels to the internode; the origin is in the middle of the screen, seen from the front. */
const SCALE = 50;
const glass = ([x, y]: Vec3): readonly [number, number] => [400 + SCALE * x, 400 - SCALE * y];
const world = (x: number, y: number, z = 0): Vec3 => [(x - 400) / SCALE, (400 - y) / SCALE, z];

/** A trunk (rows 1 to 3) with a limb to the right on 2 (rows 4 and 5). */
function setUp() {
  const parent = [-1, 0, 1, 2, 2, 4];
  const position = [
    [0, 0, 0],
    [0, 1, 0],
    [0, 2, 0],
    [0, 3, 0],
    [2, 2, 0],
    [4, 2, 0],
  ];
  const rows = {
    rows: 6,
    parent,
    startsAxis: [0, 1, 0, 0, 1, 0],
    radiusCode: [0, 9, 9, 9, 9, 9],
    position: position.flat(),
  };
  const sent: Command[] = [];
  const said: string[] = [];
  let shown: Rotation | null = null;
  const held = new HeldBranch({
    rows,
    submit: (command) => sent.push(command),
    newGesture: () => 1,
    busy: () => false,
    branchAbove: () => [4, 5],
    showTurn: (turn) => {
      shown = turn?.rotation ?? null;
    },
    showCopy: () => {},
  });
  const tool = new BranchTool({
    branch: held,
    say: (sentence) => said.push(sentence),
    view: {
      pick: (x, y, tolerance) => {
        const far = (row: number) =>
          Math.hypot(...glass(position[row] as unknown as Vec3).map((at, i) => at - [x, y][i]!));
        const row = [1, 2, 3, 4, 5].sort((a, b) => far(a) - far(b))[0] ?? 1;
        return far(row) <= tolerance ? { row, point: position[row] as unknown as Vec3 } : null;
      },
      pointOnPlane: (x, y, through) => world(x, y, through[2]),
      drawingPlane: () => ({ right: [1, 0, 0], up: [0, 1, 0] }),
      projector: () => glass,
    },
  });
  const drag = (from: Vec3, to: Vec3) => {
    tool.gripBegin(1, ...glass(from), SLOP);
    tool.gripMove(1, ...glass(to));
  };
  const tap = (at: Vec3) => {
    tool.gripBegin(1, ...glass(at), SLOP);
    tool.gripEnd(1);
  };
  return { held, tool, sent, said, drag, tap, shown: () => shown };
}

const tip: Vec3 = [4, 2, 0];
const near = (actual: readonly number[], wanted: readonly number[]) => {
  for (const [i, value] of wanted.entries()) {
    expect(actual[i]).toBeCloseTo(value, 5);
  }
};

describe("one finger", () => {
  it("takes a branch and turns it in one go", () => {
    const { held, tool, sent, drag, shown } = setUp();
    drag(tip, [0, 6, 0]);
    expect(held.row.peek()).toBe(4);
    // The tip was gripped; it is under the finger, above the base.
    near(turned(shown() ?? [0, 0, 0, 1], [4, 0, 0]), [0, 4, 0]);
    tool.gripEnd(1);
    expect(sent.map(({ kind }) => kind)).toEqual(["turn_branch"]);
  });

  it("that only taps turns nothing", () => {
    const { held, sent, tap } = setUp();
    tap(tip);
    expect(held.row.peek()).toBe(4);
    tap(tip);
    expect(held.row.peek()).toBe(5);
    expect(sent).toEqual([]);
  });

  it("lets go with a tap beside everything", () => {
    const { held, tap } = setUp();
    tap(tip);
    tap([-6, 5, 0]);
    expect(held.row.peek()).toBeNull();
  });

  it("turns by the ring as well", () => {
    const { tool, sent, drag, tap } = setUp();
    tap(tip);
    drag([0.5, 2, 0], [0, 2.5, 0]);
    tool.gripEnd(1);
    expect(sent.map(({ kind }) => kind)).toEqual(["turn_branch"]);
  });

  it("a message says that the whole tree stays where it is", () => {
    const { held, said, tap } = setUp();
    tap([0, 1, 0]);
    expect([held.row.peek(), said.length]).toEqual([null, 1]);
  });
});

describe("a second finger", () => {
  it("twists the branch about itself", () => {
    const { tool, drag, shown, sent } = setUp();
    drag(tip, [4, 2.3, 0]);
    tool.gripMove(1, ...glass(tip));
    expect(tool.takes()).toBe("take");
    tool.gripBegin(2, 700, 300, SLOP);
    expect(tool.takes()).toBe("ignore");
    // Round the first finger, which holds the tip at (600, 300), a quarter of the way.
    tool.gripMove(2, 600, 200);
    const rotation = shown() ?? [0, 0, 0, 1];
    near(turned(rotation, [4, 0, 0]), [4, 0, 0]);
    near(turned(rotation, [0, 1, 0]), [0, 0, 1]);
    tool.gripEnd(2);
    tool.gripEnd(1);
    expect(sent.map(({ kind }) => kind)).toEqual(["turn_branch"]);
  });

  it("moves the view where the first is on nothing", () => {
    const { tool, sent } = setUp();
    tool.gripBegin(1, ...glass([-6, 5, 0]), SLOP);
    expect(tool.takes()).toBe("leave");
    tool.gripDrop();
    expect(tool.takes()).toBe("take");
    expect(sent).toEqual([]);
  });

  it("that takes the view cancels what the first has turned", () => {
    const { tool, drag, shown, sent } = setUp();
    drag(tip, [0, 6, 0]);
    tool.gripDrop();
    expect([shown(), sent]).toEqual([null, []]);
  });
});

describe("placing", () => {
  it("grafts where the finger lifts from a limb", () => {
    const { held, tool, sent, tap } = setUp();
    tap(tip);
    held.beginPlacing("copy");
    tap([0, 3, 0]);
    expect(sent).toMatchObject([{ kind: "graft", row: 4, onto: 3, keep: true }]);
    expect(tool.takes()).toBe("take");
  });

  it("points the branch where the finger goes from the limb", () => {
    const { held, tool, sent, drag, tap } = setUp();
    tap(tip);
    held.beginPlacing("move");
    drag([0, 3, 0], [-4, 3, 0]);
    tool.gripEnd(1);
    const graft = sent[0];
    const rotation: Rotation = graft?.kind === "graft" ? graft.rotation : [0, 0, 0, 1];
    near(turned(rotation, [1, 0, 0]), [-1, 0, 0]);
  });

  it("says so where there is no limb, and waits for one", () => {
    const { held, said, sent, tap } = setUp();
    tap(tip);
    held.beginPlacing("move");
    tap([-6, 5, 0]);
    expect([said.length, sent, held.placing.peek()]).toEqual([1, [], "move"]);
  });

  it("ends with Escape, and then lets go of the branch", () => {
    const { held, tool, tap } = setUp();
    tap(tip);
    held.beginPlacing("move");
    expect([tool.release(), held.placing.peek(), held.row.peek()]).toEqual([true, null, 4]);
    expect([tool.release(), held.row.peek(), tool.release()]).toEqual([true, null, false]);
  });
});
