import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../../scene/vector";
import { type Command, MAX_MESSAGE_BYTES } from "../../../wire/generated";
import { copiesOf, OFF } from "../symmetry/symmetry";
import { LassoTool } from "./lasso-tool";
import type { Point2 } from "./outline";
import type { OutlineTaker } from "./outline-trace";

/** A view turned a quarter: a pixel is a tenth of an internode, to the right is −z, up is y, from pixel 1000. */
function setUp() {
  const sent: Command[] = [];
  const world = {
    branch: null as Vec3 | null,
    bud: null as number | null,
    depth: 1,
    slips: 0,
    refusals: 0,
    repeated: [] as readonly (readonly Point2[])[],
    outlines: [] as readonly (readonly Vec3[])[],
    symmetry: OFF,
    taker: null as OutlineTaker | null,
  };
  const drawn: (readonly Point2[] | null)[] = [];
  const tool = new LassoTool({
    view: {
      pointOnPlane: (x, y, through) => [through[0], (1000 - y) / 10, -x / 10],
      pick: () => (world.branch ? { row: 1, point: world.branch } : null),
      projector:
        () =>
        ([, y, z]) => [-10 * z, 1000 - 10 * y],
      drawingPlane: (through) => ({ origin: [...through], right: [0, 0, -1], up: [0, 1, 0] }),
    },
    submit: (command) => sent.push(command),
    bud: () => world.bud,
    depth: () => world.depth,
    base: () => [2, 0, 0],
    taker: () => world.taker,
    copies: () => copiesOf(world.symmetry, { foot: [2, 0, -40], mirrorNormal: [0, 0, -1] }),
    newGesture: () => sent.length + 1,
    draw: (outline, repeated) => {
      drawn.push(outline && [...outline]);
      world.repeated = repeated;
    },
    sent: (outlines) => {
      world.outlines = outlines;
    },
    tooSmall: () => {
      world.slips += 1;
    },
    refused: () => {
      world.refusals += 1;
    },
  });
  const draw = (points: readonly (readonly [number, number])[]) => {
    const strokes = points.map(([x, y]) => ({ x, y, pressure: null }));
    tool.begin(strokes[0]!);
    tool.move(strokes.slice(1));
  };
  return { tool, sent, world, drawn, draw };
}

const square: [number, number][] = [
  [100, 900],
  [300, 900],
  [300, 700],
  [100, 700],
];

describe("lasso tool", () => {
  it("LA1: sends an outline and its mirror image as one gesture, and shows both", () => {
    const { tool, sent, world, draw } = setUp();
    world.symmetry = { ...OFF, kind: "mirror" };
    draw(square);
    expect(world.repeated).toEqual([square.map(([x, y]) => [800 - x, y])]);
    tool.end();
    expect(sent.map((command) => command.gesture)).toEqual([1, 1]);
    const planes = sent.map((command) => command.kind === "lasso" && command.plane);
    expect(planes).toEqual([
      { origin: [2, 0, 0], right: [0, 0, -1], up: [0, 1, 0] },
      { origin: [2, 0, -80], right: [0, 0, 1], up: [0, 1, 0] },
    ]);
    expect(world.outlines).toHaveLength(2);
    expect(world.outlines[1]![0]).toEqual([2, 10, -70]);
  });

  it("sends what was drawn, in internodes on the drawing plane", () => {
    const { tool, sent, draw } = setUp();
    draw(square);
    expect(sent, "nothing before the finger lifts").toEqual([]);
    tool.end();
    expect(sent).toEqual([
      {
        kind: "lasso",
        outline: [
          [10, 10],
          [30, 10],
          [30, 30],
          [10, 30],
        ],
        plane: { origin: [2, 0, 0], right: [0, 0, -1], up: [0, 1, 0] },
      },
    ]);
  });

  it("says how deep the body is unless it is as deep as wide", () => {
    const { tool, sent, world, draw } = setUp();
    world.depth = 0.25;
    draw(square);
    tool.end();
    expect(sent[0]).toMatchObject({ kind: "lasso", depth: 0.25 });
  });

  it("lies at the depth of the branch it began on", () => {
    const { tool, sent, world, draw } = setUp();
    world.branch = [-7, 3, 1];
    draw(square);
    world.branch = [30, 0, 0];
    tool.end();
    expect(sent[0]).toMatchObject({
      plane: { origin: [-7, 3, 1] },
      outline: [
        [11, 7],
        [31, 7],
        [31, 27],
        [11, 27],
      ],
    });
    expect(world.outlines[0]?.map(([x]) => x)).toEqual([-7, -7, -7, -7]);
  });

  it("SG1: names the branch that alone may grow", () => {
    const { tool, sent, world, draw } = setUp();
    world.bud = 12;
    draw(square);
    tool.end();
    expect(sent[0]).toMatchObject({ bud: 12 });
  });

  it("shows the outline while it is drawn and not after", () => {
    const { tool, drawn, draw } = setUp();
    draw(square);
    expect(drawn[drawn.length - 1]).toEqual(square);
    tool.end();
    expect(drawn[drawn.length - 1]).toBeNull();
  });

  it("a tap, a line and a small loop are slips", () => {
    const { tool, sent, world, draw } = setUp();
    for (const slip of [
      [[5, 5]],
      [
        [0, 900],
        [400, 500],
      ],
      [
        [0, 900],
        [20, 900],
        [20, 880],
      ],
    ] as Point2[][]) {
      draw(slip);
      tool.end();
    }
    expect([sent, world.slips]).toEqual([[], 3]);
  });

  it("a drawing that is cancelled leaves no trace", () => {
    const { tool, sent, world, drawn, draw } = setUp();
    draw(square);
    tool.abandon();
    tool.move([{ x: 1, y: 1, pressure: null }]);
    tool.end();
    expect([sent, world.slips, drawn[drawn.length - 1]]).toEqual([[], 0, null]);
  });

  it("LM1: the longest scribble fits into a message", () => {
    const { tool, sent, draw } = setUp();
    let at = 1;
    draw(
      Array.from({ length: 30_000 }, (): Point2 => {
        at = (at * 16807) % 2147483647;
        return [(at % 100_003) / 7, (at % 99_991) / 7];
      }),
    );
    tool.end();
    const command = sent[0];
    const points = command?.kind === "lasso" ? command.outline.length : 0;
    expect(points).toBeGreaterThan(1000);
    expect(points).toBeLessThanOrEqual(4096);
    expect(JSON.stringify(command).length).toBeLessThan(MAX_MESSAGE_BYTES / 2);
  });

  it("tells of an outline that is refused, and of no other command", () => {
    const { tool, sent, world, draw } = setUp();
    draw(square);
    tool.end();
    tool.refused({ kind: "undo" });
    expect(world.refusals).toBe(0);
    tool.refused(sent[0]!);
    expect(world.refusals).toBe(1);
  });
});
