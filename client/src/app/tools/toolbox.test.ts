import { afterEach, describe, expect, it, vi } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { SMALL, tableOf } from "../../../test/small-tree";
import { Virtual } from "../../../test/virtual-clock";
import type { BendOverlay } from "../../scene/overlay/bend-overlay";
import type { SlotWriter } from "../../scene/overlay/overlays";
import type { Vec3 } from "../../scene/vector";
import type { Viewport } from "../../scene/viewport";
import type { BendFrame, RowMotion } from "../../wire/bend-frame";
import type { Command, WidthConstraint } from "../../wire/generated";
import { ObstacleList } from "../document/obstacles/obstacle-list";
import { loadSettings } from "../page/settings";
import { Toasts } from "../page/toasts";
import { SharedBends } from "./bend/shared-bends";
import type { HeldBranch } from "./branch/held-branch";
import { StrokeTrail } from "./brush/stroke-trail";
import { ChosenBud } from "./chosen-bud";
import { OutlineTrace } from "./lasso/outline-trace";
import { Toolbox } from "./toolbox";
import { TOOL_NAMES, TOOLS } from "./tools";
import { WidthList } from "./width/width-list";

afterEach(() => vi.useRealTimers());

/** A view in which a pixel is a tenth of an internode and y goes up from pixel 1000; a branch at x = 50, a box at 80. */
function setUp(table = new PlainTable()) {
  vi.useFakeTimers();
  const sent: Command[] = [];
  const world = { arranging: false, ready: true, chosen: [] as number[][], held: 0, overlays: new Set<BendOverlay>() };
  const store = { getItem: () => null, setItem: () => {} } as unknown as Storage;
  const view = {
    pointOnPlane: (x: number, y: number, through: Vec3) => [x / 10, (1000 - y) / 10, through[2]],
    pointOnLevel: (x: number, y: number) => (y > 500 ? [x / 10, 0, y / 10] : null),
    drawingPlane: (through: Vec3) => ({ origin: [...through], right: [1, 0, 0], up: [0, 1, 0] }),
    pick: (x: number) => (Math.abs(x - 500) < 24 ? { row: 3, point: [50, 0, 0] } : null),
    placeOf: (row: number) => [50, row, 0],
    seenAt: (row: number) => [50, row, 0],
    projector: () => (point: Vec3) => [10 * point[0], 1000 - 10 * point[1]],
    addOverlay: (bent: BendOverlay) => world.overlays.add(bent),
    removeOverlay: (bent: BendOverlay) => world.overlays.delete(bent),
    hasOverlay: (bent: BendOverlay) => world.overlays.has(bent),
    overlayChanged: () => {},
    pickObstacle: (x: number) => (Math.abs(x - 800) < 24 ? { id: 1, point: [80, 0, 0] } : null),
    depthBelow: () => null,
    looksDown: () => false,
    showBrush: () => {},
    widest: () => 40,
    hideBrush: () => {},
  } as unknown as Viewport;
  const submit = (command: Command) => sent.push(command);
  const obstacles = new ObstacleList({
    submit,
    newGesture: () => 1,
    ahead: () => ({ step: 0, pending: 0 }),
    clock: new Virtual(),
    session: () => null,
    simplified: () => {},
    failed: () => {},
  });
  obstacles.receive([{ id: 1, shape: { kind: "sphere", radius: 2 }, pose: { position: [80, 0, 0] } }]);
  const toasts = new Toasts();
  const [outline, widths, bends] = [new OutlineTrace(), new WidthList(), new SharedBends()];
  const tools = new Toolbox({
    outline,
    trail: new StrokeTrail(),
    widths,
    bends,
    table,
    settings: loadSettings(store),
    toasts,
    bud: new ChosenBud({ rows: 0, position: [], radiusCode: [] }),
    obstacles,
    submit,
    next: () => sent.length + 1,
    unsettledMoves: () => 0,
    unsettled: () => 0,
    girth: () => ({ exponent: 2.5, twigDiameter: 0.07 }),
    branch: {
      release: () => {},
      hide: () => {},
      row: { peek: () => null },
      placing: { peek: () => null },
      cancelTurn: () => {},
      cancelPlacing: () => {},
    } as unknown as HeldBranch,
    predict: () => {},
    hold: () => {
      world.held += 1;
      return () => {
        world.held -= 1;
      };
    },
    ready: () => world.ready,
    arranging: () => world.arranging,
    choose: (x, y) => world.chosen.push([x, y]),
    tapped: () => {},
  });
  tools.attach(view);
  const at = (x: number, y: number) => ({ x, y, pressure: null });
  const begin = (points: readonly (readonly [number, number])[]) => {
    const [first, ...rest] = points.map(([x, y]) => at(x, y));
    tools.gesture({ kind: "stroke-begin", point: first! });
    tools.gesture({ kind: "stroke-move", points: rest });
  };
  const draw = (points: readonly (readonly [number, number])[]) => {
    begin(points);
    tools.gesture({ kind: "stroke-end" });
  };
  return { tools, outline, widths, bends, view, sent, world, toasts, obstacles, begin, draw };
}

const kinds = (commands: Command[]) => commands.map(({ kind }) => kind);
const ring: [number, number][] = [
  [200, 300],
  [400, 300],
  [400, 100],
  [200, 100],
];

describe("toolbox", () => {
  it("holds the picture once for each stroke", () => {
    const { tools, world, begin } = setUp();
    for (let i = 0; i < 3; i += 1) {
      begin(ring);
      expect(world.held).toBe(1);
      tools.gesture({ kind: "stroke-end" });
      expect(world.held).toBe(0);
    }
    begin(ring);
    tools.abandon();
    expect(world.held).toBe(0);
  });

  it("knows what hands are at, from the first touch on until they are gone", async () => {
    const { tools, view, world, begin, bends } = setUp(tableOf(SMALL));
    const blown: { air: unknown } = view;
    blown.air = { blowing: true, sways: false };
    const at = (x: number) => ({ x, y: 300, pressure: null });
    tools.gesture({ kind: "stroke-begin", point: at(500) });
    expect(tools.touched.value).toEqual({ rows: [3], elsewhere: 0.25 });
    tools.gesture({ kind: "stroke-end" });
    expect(tools.touched.value).toBeNull();
    begin(ring);
    expect(tools.touched.value, "beside every branch").toEqual({ rows: [], elsewhere: 0.25 });
    tools.cancel();
    expect(tools.touched.value).toBeNull();
    tools.gesture({ kind: "hold-begin", x: 500, y: 300, milliseconds: 400 });
    expect(tools.touched.value?.rows).toEqual([3]);
    tools.gesture({ kind: "hold-end" });
    expect(tools.touched.value).toBeNull();
    tools.choose("prune");
    begin(ring);
    expect(tools.touched.value, "a line through the tree").toEqual({ rows: [], elsewhere: 0 });
    tools.abandon();
    expect(tools.touched.value).toBeNull();
    await tools.load("bend");
    tools.choose("bend");
    bends.receive({ epoch: 1, sequence: 1, bend: 4, motions: [] });
    expect([tools.touched.value, world.held], "others' hands are not this page's").toEqual([null, 0]);
    tools.gesture({ kind: "grip-begin", id: 1, x: 500, y: 300, slop: 5 });
    tools.gesture({ kind: "grip-begin", id: 2, x: 505, y: 300, slop: 5 });
    expect(tools.touched.value).toEqual({ rows: [3, 3], elsewhere: 0.25 });
    tools.gesture({ kind: "grip-end", id: 1 });
    expect(tools.touched.value?.rows).toEqual([3, 3]);
    tools.gesture({ kind: "grip-end", id: 2 });
    expect(tools.touched.value).toBeNull();
    blown.air = null;
    tools.choose("brush");
    tools.gesture({ kind: "stroke-begin", point: at(500) });
    expect(tools.touched.value?.rows, "nothing is looked for where no wind blows").toEqual([]);
  });

  it("widths that come before the tools are not lost", async () => {
    const { tools, view, widths } = setUp();
    tools.detach();
    const set = [{ row: 3, diameter: 0.5 }] as unknown as WidthConstraint[];
    widths.all.value = set;
    tools.attach(view);
    await tools.load("width");
    expect(tools.made.value?.width?.widths.value).toEqual(set);
  });

  it("BE5: bends that come before the tools are not lost", async () => {
    const { tools, bends, view, world } = setUp(tableOf(SMALL));
    const frameOf = (bend: number, rows: number[], x = 0): BendFrame => {
      const motions = rows.map((row): RowMotion => ({ row, rotation: [0, 0, 0, 1], to: [x, row, 0] }));
      return { epoch: 1, sequence: 1, bend, motions };
    };
    const shown = () => [...world.overlays].map(({ path }) => path);
    tools.detach();
    bends.detach();
    world.overlays.clear();
    for (const frame of [frameOf(7, [2, 6, 7]), frameOf(8, [3, 12]), frameOf(7, [2, 6, 7], 9), frameOf(8, [])]) {
      bends.receive(frame);
    }
    tools.attach(view);
    await tools.load("bend");
    expect(shown(), "only that which is not over").toEqual([[2, 6, 7]]);
    const motion = vi.fn();
    const out = { plain: () => {}, orientation: () => {}, motion } as unknown as SlotWriter;
    [...world.overlays][0]?.write(tableOf(SMALL), out);
    expect(motion.mock.lastCall?.[3], "the frame received last").toEqual([9, 7, 0]);
    bends.receive(frameOf(7, []));
    expect(shown()).toEqual([]);
    bends.receive(frameOf(9, [3, 12]));
    tools.detach();
    bends.clear();
    world.overlays.clear();
    tools.attach(view);
    expect(shown(), "another connection tells anew").toEqual([]);
  });

  it("a pen's pressure reaches what is sent", () => {
    const { tools, sent } = setUp();
    const pressed = (x: number, pressure: number) => ({ x, y: 300, pressure });
    tools.gesture({ kind: "stroke-begin", point: pressed(100, 0.5) });
    tools.gesture({ kind: "stroke-move", points: Array.from({ length: 30 }, (_, i) => pressed(110 + 10 * i, 1)) });
    tools.gesture({ kind: "stroke-end" });
    const radii = sent
      .flatMap((command) => (command.kind === "stroke_move" ? command.samples : []))
      .map((s) => s.radius);
    expect(radii.length).toBeGreaterThan(10);
    expect(radii.every((radius, i) => i === 0 || radius >= radii[i - 1]!)).toBe(true);
    expect(radii.at(-1)! / radii[0]!).toBeCloseTo(1.8, 1);
  });

  it("a stroke goes to the tool that was chosen", async () => {
    const { tools, sent, outline, draw } = setUp();
    draw(ring);
    expect(kinds(sent)).toEqual(["stroke_begin", "stroke_move", "stroke_end"]);
    await tools.load("lasso");
    tools.choose("lasso");
    draw(ring);
    expect(kinds(sent.splice(0)).slice(3)).toEqual(["lasso"]);
    expect(outline.shown.value?.stage).toBe("growing");
  });

  it("a seed leaves its tool in the hand, for the next one", () => {
    const { tools, sent, toasts, draw } = setUp();
    tools.choose("seed");
    draw([[300, 200]]);
    expect([sent, tools.chosen.value, toasts.list.value.length]).toEqual([[], "seed", 1]);
    draw([[300, 700]]);
    expect(sent).toEqual([{ kind: "plant_seed", position: [30, 0, 70] }]);
    expect([tools.chosen.value, tools.made.value?.seed?.coming.value]).toEqual(["seed", null]);
  });

  it("a tool that changes ends its stroke", () => {
    const { tools, sent, begin } = setUp();
    begin(ring);
    tools.choose("lasso");
    expect([kinds(sent).at(-1), tools.drawing.value]).toEqual(["stroke_end", false]);
    tools.gesture({ kind: "stroke-move", points: [{ x: 1, y: 1, pressure: null }] });
    tools.gesture({ kind: "stroke-end" });
    expect(kinds(sent).at(-1)).toBe("stroke_end");
  });

  it("cancelling forgets an outline and ends a brush stroke", async () => {
    const { tools, sent, outline, begin } = setUp();
    await tools.load("lasso");
    tools.choose("lasso");
    begin(ring);
    expect(outline.shown.value?.stage).toBe("drawing");
    tools.cancel();
    tools.gesture({ kind: "stroke-end" });
    expect([sent, outline.shown.value, tools.drawing.value]).toEqual([[], null, false]);
    tools.choose("brush");
    begin(ring);
    tools.cancel();
    expect(kinds(sent).at(-1)).toBe("stroke_end");
  });

  it("a finger on an obstacle moves it while the scene is arranged, and draws otherwise", () => {
    const { sent, world, obstacles, draw } = setUp();
    const across: [number, number][] = [
      [800, 500],
      [900, 500],
    ];
    draw(across);
    expect(kinds(sent.splice(0))).toContain("stroke_begin");
    world.arranging = true;
    draw(across);
    expect(kinds(sent)).toEqual(["move_obstacle"]);
    expect(obstacles.poseOf(1)?.position[0]).toBe(90);
    draw(ring);
    expect(kinds(sent), "beside it the brush still draws").toContain("stroke_begin");
  });

  it("a branch can be held with the tools that grow", () => {
    const { tools, world } = setUp();
    expect([tools.holdable(500, 500), tools.holdable(900, 500)]).toEqual([true, false]);
    tools.choose("lasso");
    expect(tools.holdable(500, 500)).toBe(true);
    tools.choose("seed");
    expect(tools.holdable(500, 500)).toBe(false);
    tools.choose("brush");
    world.ready = false;
    expect(tools.holdable(500, 500), "nor without a session").toBe(false);
  });

  it("what was held long enough is chosen", () => {
    const { tools, sent, world } = setUp();
    tools.gesture({ kind: "hold-begin", x: 5, y: 6, milliseconds: 340 });
    expect(tools.hold.value).toMatchObject({ x: 5, y: 6, milliseconds: 340 });
    tools.gesture({ kind: "hold-end" });
    tools.gesture({ kind: "choose", x: 5, y: 6 });
    expect([tools.hold.value, world.chosen, sent]).toEqual([null, [[5, 6]], []]);
  });

  it("a double tap goes to the shears, from the tools that draw growth", () => {
    const { tools, sent, toasts } = setUp();
    const doubles = TOOL_NAMES.filter((tool) => {
      tools.choose(tool);
      return tools.doubles();
    });
    expect(doubles).toEqual(["brush", "lasso"]);
    tools.choose("brush");
    tools.gesture({ kind: "double-tap", x: 900, y: 500 });
    expect([sent, toasts.list.value.length], "nothing is there").toEqual([[], 0]);
    tools.gesture({ kind: "double-tap", x: 500, y: 500 });
    expect([sent, toasts.list.value.length], "what cannot be cut is explained").toEqual([[], 1]);
  });

  it("a tool that takes hold gets its fingers, and the view what it leaves", async () => {
    const { tools, world } = setUp();
    expect(tools.grip(500, 500), "the brush draws").toBeNull();
    tools.choose("width");
    await tools.load("width");
    expect(tools.grip(500, 500)).toBe("take");
    tools.gesture({ kind: "grip-begin", id: 1, x: 500, y: 500, slop: 9 });
    expect([tools.drawing.value, tools.grip(900, 500)]).toEqual([true, "leave"]);
    tools.gesture({ kind: "grip-drop" });
    expect(tools.drawing.value).toBe(false);
    tools.gesture({ kind: "grip-begin", id: 1, x: 500, y: 500, slop: 9 });
    tools.gesture({ kind: "grip-end", id: 1 });
    expect([tools.drawing.value, tools.made.value?.width?.chosen.value]).toEqual([false, 3]);
    expect([tools.release(), tools.release()], "Escape takes the ring away first").toEqual([true, false]);
    world.ready = false;
    expect(tools.grip(500, 500)).toBeNull();
  });

  it("a tool whose code does not come says so when it is chosen, and is loaded when it is chosen again", async () => {
    const { tools, toasts } = setUp();
    vi.spyOn(console, "warn").mockImplementation(() => {});
    const make = vi.spyOn(TOOLS.branch, "make").mockRejectedValueOnce(new Error("offline"));
    await tools.load("branch");
    await tools.load("branch");
    expect([make.mock.calls.length, toasts.list.value.length], "nobody asked for it").toEqual([1, 0]);
    tools.choose("branch");
    await vi.waitFor(() => expect(tools.chosen.value).toBe("brush"));
    expect([tools.made.value?.branch, toasts.list.value.length]).toEqual([undefined, 1]);
    tools.choose("branch");
    await vi.waitFor(() => expect(tools.made.value?.branch).toBeDefined());
    expect([tools.chosen.value, make.mock.calls.length]).toEqual(["branch", 2]);
    vi.restoreAllMocks();
  });

  it("a press can wait for the code of its tool", async () => {
    const { tools } = setUp();
    expect(tools.loading(), "the brush is there").toBeNull();
    tools.choose("width");
    const loading = tools.loading();
    expect(tools.made.value?.width).toBeUndefined();
    expect([await loading, tools.loading()]).toEqual([true, null]);
    tools.choose("bend");
    const left = tools.loading();
    tools.choose("brush");
    expect(await left, "another tool has been chosen").toBe(false);
  });

  it("without a session nothing is drawn", () => {
    const { tools, sent, world, draw } = setUp();
    world.ready = false;
    draw(ring);
    expect([sent, tools.drawing.value]).toEqual([[], false]);
  });
});
