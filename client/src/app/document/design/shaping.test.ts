import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Envelope } from "../../../scene/structure/envelope-surface";
import type { Vec3 } from "../../../scene/vector";
import type { Command, DesignInForce, PlacedBranch } from "../../../wire/generated";
import type { Gesture } from "../../input/gesture";
import { type Handle, handlesOf } from "./branch-handles";
import { DesignEditing } from "./design-editing";
import { DesignSignal } from "./design-signal";
import { Shaping } from "./shaping";

const SQRT = Math.SQRT1_2;

/** A branch at a place that goes up, or towards +x. */
function placed(path: string, base: Vec3, length: number, isLevel = false): PlacedBranch {
  // Y to X about Z.
  const turn: [number, number, number, number] = isLevel ? [0, 0, -SQRT, SQRT] : [0, 0, 0, 1];
  return {
    path,
    base: [...base],
    frame: turn,
    outline: turn,
    length,
    radius: 0.2,
    at: 0.5,
    heading: [0, 1, 0],
    outside: false,
    bears: 2,
  };
}

const BRANCHES = [
  placed("/", [0, 0, 0], 40),
  placed("/0", [0, 10, 0], 12, true),
  placed("/1", [0, 20, 0], 8, true),
  placed("/0/0", [6, 10, 0], 4),
];

/** A pixel is a tenth of an internode, y up, seen from the front. */
function setUp(values: Record<string, unknown> = {}, laterals: unknown = undefined) {
  const sent: Command[] = [];
  const looked: (string | null)[] = [];
  const world = { now: 0, holds: 0, unsettled: 0, later: [] as (() => void)[], unfitted: [] as string[] };
  const design = new DesignSignal();
  const told: DesignInForce = {
    at: [0, 0, 0],
    graph: { version: 1, nodes: { "/0": { values } }, ...(laterals ? { laterals } : {}) },
    values: 0,
    branches: 4,
    laterals: { "/": [0, 1], "/0": [0] },
    asleep: [],
    steps_on_top: 0,
    row: 0,
  };
  design.receive(told);
  design.placed.value = { of: "/", branches: BRANCHES };
  const editing = new DesignEditing({
    design,
    submit: (command) => sent.push(command),
    newGesture: () => 7,
    unsettled: () => world.unsettled,
    now: () => world.now,
    later: (run) => world.later.push(run),
  });
  const shaping = new Shaping({
    editing,
    design,
    view: () => ({
      pointOnPlane: (x, y, through) => [x / 10, -y / 10, through[2]],
      projector:
        () =>
        ([x, y]) => [10 * x, -10 * y],
      rayAt: (x, y) => ({ origin: [x / 10, -y / 10, 100], direction: [0, 0, -1] }),
    }),
    shells: () => null,
    mayChange: signal(true),
    connected: signal(true),
    look: (of) => looked.push(of),
    hold: () => {
      world.holds += 1;
      return () => {
        world.holds -= 1;
      };
    },
    now: () => world.now,
    unfitted: (why) => world.unfitted.push(why),
  });
  shaping.wanted.value = true;
  const handle = (id: string): Handle => {
    const shape = shaping.chosen.peek();
    const found = shape && handlesOf(shape).find((one) => one.id === id);
    if (!found) {
      throw new Error(`There is no handle ${id}.`);
    }
    return found;
  };
  const drag = (id: string, ...places: readonly (readonly [number, number])[]) => {
    shaping.grip(handle(id));
    for (const [x, y] of places) {
      world.now += 50;
      shaping.drag(x, y);
    }
  };
  const stroke = (...points: readonly (readonly [number, number])[]): (Gesture | null)[] => {
    const at = ([x, y]: readonly [number, number]) => ({ x, y, pressure: null });
    const [first = [0, 0], ...rest] = points;
    const gestures: Gesture[] = [
      { kind: "stroke-begin", point: at(first) },
      ...rest.map((point) => ({ kind: "stroke-move", points: [at(point)] }) as const),
      { kind: "stroke-end" },
    ];
    return gestures.map((gesture) => design.hands?.(gesture) ?? null).filter((gesture) => gesture !== null);
  };
  return { design, editing, shaping, sent, looked, world, drag, stroke };
}

const edits = (command: Command | undefined) => (command?.kind === "edit_design" ? command.edits : []);

describe("shaping by hand", () => {
  it("a tap chooses a branch, a second one goes deeper, and one beside everything goes up", () => {
    const { editing, shaping, looked, world, stroke } = setUp();
    expect(shaping.shown.value.map(({ path, emphasis }) => `${path} ${emphasis}`)).toEqual([
      "/0 beside",
      "/1 beside",
      "/ chosen",
    ]);
    stroke([70, -102]);
    expect(editing.chosen.value).toBe("/0");
    expect(editing.unfolded.value.has("/")).toBe(true);
    stroke([70, -102]);
    expect(editing.chosen.value).toBe("/0/0");
    expect(looked).toEqual(["/", "/0", "/0/0"]);
    // What is not beside it, but beside its bearer.
    world.now += 1000;
    stroke([50, -202]);
    expect(editing.chosen.value).toBe("/1");
    expect(shaping.shown.value.map(({ path, emphasis }) => `${path} ${emphasis}`)).toEqual([
      "/ around",
      "/0 beside",
      "/1 chosen",
    ]);
    world.now += 1000;
    stroke([300, -300]);
    expect(editing.chosen.value).toBe("/");
  });

  it("a finger that wanders turns the view, and others move it as always", () => {
    const { design, editing, stroke } = setUp();
    expect(stroke([70, -102], [72, -102], [100, -90])).toEqual([{ kind: "orbit", dx: 30, dy: 12 }]);
    expect(editing.chosen.value).toBe("/");
    const zoom: Gesture = { kind: "zoom", factor: 2, x: 0, y: 0 };
    expect(design.hands?.(zoom)).toEqual(zoom);
    expect(design.hands?.({ kind: "double-tap", x: 0, y: 0 })).toBeNull();
  });

  it("the tip goes with the finger, all of it one gesture", () => {
    const { editing, shaping, sent, world, drag } = setUp();
    editing.choose("/0");
    drag("tip", [120, -130], [100, -160]);
    expect(shaping.held.value?.readout.length).toBeCloseTo(Math.hypot(10, 6), 3);
    expect(shaping.held.value?.readout.angle).toBeCloseTo(59.04, 1);
    expect(shaping.chosen.value?.tip[1]).toBeCloseTo(16, 3);
    expect(world.holds).toBe(1);
    shaping.release();
    expect(sent.map((command) => (command.kind === "edit_design" ? command.gesture : null))).toEqual([7, 7, 7]);
    expect(edits(sent.at(-1))).toEqual([{ edit: "aim", node: "/0", tip: [10, 16, 0] }]);
    expect([shaping.held.value, world.holds]).toEqual([null, 0]);
  });

  it("while the server is busy the newest waits, and is sent when it is not", () => {
    const { editing, shaping, sent, world, drag } = setUp();
    editing.choose("/0");
    drag("tip", [120, -130]);
    world.unsettled = 1;
    for (const y of [-140, -150, -160]) {
      world.now += 50;
      shaping.drag(100, y);
    }
    expect(sent.length).toBe(1);
    world.unsettled = 0;
    world.now += 50;
    for (const run of world.later.splice(0)) {
      run();
    }
    expect(edits(sent.at(-1))).toEqual([{ edit: "aim", node: "/0", tip: [10, 16, 0] }]);
  });

  it("what is let be says again what was said before", () => {
    const { editing, shaping, sent, drag } = setUp({ reach: { multiply: 1.2 } });
    editing.choose("/0");
    drag("tip", [120, -130]);
    expect(shaping.cancel()).toBe(true);
    expect(edits(sent.at(-1))).toEqual([
      { edit: "clear", of: "/0", key: "turn" },
      { edit: "set", of: "/0", key: "reach", value: { multiply: 1.2 } },
    ]);
    expect(sent.at(-1)).toMatchObject({ gesture: 7 });
    // What has not moved is not said.
    const count = sent.length;
    shaping.grip(handlesOf(shaping.chosen.value as never)[0] as Handle);
    shaping.cancel();
    expect(sent.length).toBe(count);
  });

  it("a branch slides along its bearer, and back to where it was anchored", () => {
    const { editing, shaping, sent, drag } = setUp({}, { "/": [{ number: 0, home: 0.3, anchor: 0.3 }] });
    editing.choose("/0");
    drag("base", [4, -240]);
    expect(edits(sent.at(-1))).toEqual([{ edit: "anchor", node: "/0", at: 0.6 }]);
    expect(shaping.chosen.value?.base[1]).toBeCloseTo(24, 3);
    shaping.cancel();
    expect(edits(sent.at(-1))).toEqual([{ edit: "anchor", node: "/0", at: 0.3 }]);
  });

  it("sides that are alike stay alike, and one that is not goes alone", () => {
    const { editing, shaping, sent, drag } = setUp();
    drag("side-0", [200, -180]);
    shaping.release();
    const value = (command: Command | undefined) => {
      const [edit] = edits(command);
      return edit?.edit === "set" ? (edit.value.own as { radii: number[]; heights: number[] }) : null;
    };
    expect(value(sent.at(-1))).toMatchObject({ radii: [0.5, 0.35, 0.5, 0.35], heights: [0.45, 0.45, 0.45, 0.45] });
    expect(editing.chosen.value).toBe("/");
  });

  it("the plant grows as a whole, within its range", () => {
    const { sent, shaping, drag } = setUp();
    drag("tip", [30, -600]);
    shaping.release();
    // Nothing was said of its height, which is 60 then.
    expect(edits(sent.at(-1))).toEqual([{ edit: "set", of: "/", key: "height", value: { own: 90 } }]);
  });

  it("an axis gets a point, and loses it again", () => {
    const { editing, shaping, sent, drag } = setUp();
    editing.choose("/0");
    drag("new-0", [60, -130]);
    const [edit] = edits(sent.at(-1));
    expect(edit).toMatchObject({ edit: "set", of: "/0", key: "axis", value: { private: true } });
    expect(edit?.edit === "set" && edit.value.own).toEqual([
      [0, 0, 0],
      [-0.25, 0.5, 0],
      [0, 1, 0],
    ]);
    shaping.release();
    // Shown until the server has answered, there is but the straight axis; then a double tap takes the point away.
    const bent = shaping.chosen.value?.bent([
      [0, 0, 0],
      [-0.25, 0.5, 0],
      [0, 1, 0],
    ]);
    const point = bent && handlesOf(bent).find(({ id }) => id === "point-1");
    expect(bent && point?.without?.(bent)).toMatchObject({
      key: "axis",
      value: [
        [0, 0, 0],
        [0, 1, 0],
      ],
    });
  });

  it("an outline that is drawn becomes the silhouette, as one deed", () => {
    const { shaping, sent, world, stroke } = setUp();
    shaping.sketching.value = true;
    stroke([2, -2], [4, -3]);
    expect([world.unfitted, sent, shaping.sketching.value]).toEqual([["small"], [], true]);
    // The plant is 40 high: a cone from its middle to its top, upon a shallow bowl.
    stroke([0, -400], [100, -200], [80, -180], [0, -160], [-80, -180], [-100, -200], [0, -400]);
    expect([shaping.sketching.value, shaping.group.value, sent.length]).toEqual([false, "outline", 1]);
    const [edit] = edits(sent[0]);
    const envelope = edit?.edit === "set" ? (edit.value.own as Envelope) : null;
    expect(envelope).toMatchObject({ top: [0, 1, 0], bottom: [0, 0.4, 0], radii: [0.25, 0.25, 0.25, 0.25] });
    expect(envelope?.heights).toEqual([0.5, 0.5, 0.5, 0.5]);
    expect(envelope?.upper).toBeCloseTo(1, 1);
    expect(shaping.trace.value).toEqual([]);
  });

  it("while a finger draws the tree is held, until that ends however it does", () => {
    const { design, shaping, world } = setUp();
    const begin = () => design.hands?.({ kind: "stroke-begin", point: { x: 0, y: -400, pressure: null } });
    const end = () => design.hands?.({ kind: "stroke-end" });
    begin();
    expect(world.holds, "what turns the view").toBe(0);
    end();
    shaping.sketching.value = true;
    begin();
    expect(world.holds).toBe(1);
    end();
    expect(world.holds, "it ended").toBe(0);
    begin();
    shaping.cancel();
    expect(world.holds, "it was called off").toBe(0);
    end();
    begin();
    shaping.sketching.value = false;
    end();
    expect(world.holds, "it is no drawing any more").toBe(0);
    shaping.sketching.value = true;
    begin();
    shaping.wanted.value = false;
    expect(world.holds, "nothing is shaped any more").toBe(0);
  });

  it("an axis that is drawn goes from the base to where the stroke ends, as one deed", () => {
    const { editing, shaping, sent, world, stroke } = setUp({ roll: { own: 90 } });
    editing.choose("/0");
    shaping.group.value = "axis";
    shaping.sketching.value = true;
    stroke([0, -100], [4, -100]);
    expect([world.unfitted, sent, shaping.sketching.value]).toEqual([["small"], [], true]);
    // From the base, ten up, over a hump to eight out.
    stroke([0, -100], [20, -130], [40, -140], [60, -130], [80, -100]);
    expect([shaping.sketching.value, shaping.group.value, sent.length]).toEqual([false, "axis", 1]);
    const [aim, bend] = edits(sent[0]);
    expect(aim).toEqual({ edit: "aim", node: "/0", tip: [8, 10, 0] });
    expect(bend).toMatchObject({ edit: "set", of: "/0", key: "axis", value: { private: true } });
    const points = bend?.edit === "set" ? (bend.value.own as Vec3[]) : [];
    expect([points[0], points.at(-1)]).toEqual([
      [0, 0, 0],
      [0, 1, 0],
    ]);
    // A quarter of roll has turned the side that looked up aside: the hump is along −Z of its frame.
    const top = points[Math.floor(points.length / 2)];
    expect(top?.map((part) => Math.round(100 * part) / 100 || 0)).toEqual([0, 0.5, -0.5]);
  });

  it("a stroke that begins elsewhere is moved to the base, and one that ends there was drawn backwards", () => {
    const { editing, shaping, sent, stroke } = setUp();
    editing.choose("/0");
    shaping.group.value = "axis";
    shaping.sketching.value = true;
    stroke([300, -300], [320, -330], [380, -300]);
    shaping.sketching.value = true;
    stroke([80, -100], [20, -130], [1, -101]);
    const tips = sent.flatMap(edits).map((edit) => (edit.edit === "aim" ? edit.tip : null));
    expect(tips.filter((tip) => tip !== null)).toEqual([
      [8, 10, 0],
      [8, 10, 0],
    ]);
  });

  it("a tip stops where the server takes no lower one, in the picture too", () => {
    const { editing, shaping, sent, drag } = setUp();
    editing.choose("/0");
    drag("tip", [120, 250]);
    expect(shaping.held.value?.readout.isLowest).toBe(true);
    expect(shaping.chosen.value?.tip.map((part) => Math.round(100 * part) / 100)).toEqual([12, -10, 0]);
    expect(edits(sent.at(-1))).toEqual([{ edit: "aim", node: "/0", tip: [12, -10, 0] }]);
  });

  it("an outline that is let be is none", () => {
    const { design, shaping, sent } = setUp();
    shaping.sketching.value = true;
    const point = (x: number, y: number) => ({ x, y, pressure: null });
    design.hands?.({ kind: "stroke-begin", point: point(0, -400) });
    design.hands?.({ kind: "stroke-move", points: [point(100, -200), point(0, -160)] });
    expect(shaping.held.value?.shape.envelope.radii[0]).toBeCloseTo(0.25, 3);
    expect(shaping.cancel()).toBe(true);
    design.hands?.({ kind: "stroke-end" });
    expect([sent, shaping.held.value]).toEqual([[], null]);
  });

  it("nothing is shaped where the design is sealed", () => {
    const { design, shaping } = setUp();
    const told = design.inForce.peek();
    expect(design.hands).not.toBeNull();
    design.receive(told && { ...told, steps_on_top: 2 });
    expect([shaping.isOn.value, design.hands, shaping.shown.value]).toEqual([false, null, []]);
  });
});
