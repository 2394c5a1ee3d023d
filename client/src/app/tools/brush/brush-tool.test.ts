import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../../scene/vector";
import type { Command, StrokeSample } from "../../../wire/generated";
import { copiesOf, OFF } from "../symmetry/symmetry";
import { BrushTool } from "./brush-tool";
import { MIN_SPACING } from "./sample-queue";

/** A view in which a pixel is a tenth of an internode, y up from pixel 1000, at the depth of the plane's point. */
function setUp() {
  const sent: Command[] = [];
  const world = {
    radius: 4,
    unsettled: 0,
    pressure: false,
    branch: null as Vec3 | null,
    planes: true,
    bud: null as number | null,
    symmetry: OFF,
    widest: 40,
    /** How far the view is turned around the vertical through x = 50, in radians. */
    turned: 0,
  };
  const shown: { point: Vec3; points: readonly Vec3[]; radius: number }[] = [];
  const ghosts: { ended: number | null; places: Vec3[] }[] = [];
  const trail = {
    begin: (stroke: number) => {
      ghosts[stroke] = { ended: null, places: [] };
    },
    add: (stroke: number, position: Vec3) => ghosts[stroke]!.places.push(position),
    end: (stroke: number, command: number) => {
      ghosts[stroke]!.ended = command;
    },
    leave: () => ghosts.splice(0),
  };
  const tool = new BrushTool({
    view: {
      pointOnPlane: (x, y, through) => {
        const [aside, out] = [x / 10 - 50, through[2]];
        const [sin, cos] = [Math.sin(world.turned), Math.cos(world.turned)];
        return world.planes ? [50 + aside * cos + out * sin, (1000 - y) / 10, out * cos - aside * sin] : null;
      },
      pick: () => (world.branch ? { row: 1, point: world.branch } : null),
      widest: () => world.widest,
      showBrush: (points, radius) => shown.push({ point: points[0]!, points, radius }),
      hideBrush: () => shown.splice(0),
    },
    submit: (command) => sent.push(command),
    next: () => sent.length + 1,
    trail,
    unsettledMoves: () => world.unsettled,
    radius: () => world.radius,
    pressureWidens: () => world.pressure,
    bud: () => world.bud,
    base: () => [0, 0, 2],
    copies: () => copiesOf(world.symmetry, { foot: [0, 0, 0], mirrorNormal: [1, 0, 0] }),
    drawn: () => {},
  });
  const samples = (): StrokeSample[] =>
    sent.flatMap((command) => (command.kind === "stroke_move" ? command.samples : []));
  return { tool, sent, world, shown, samples, ghosts };
}

const at = (x: number, y: number, pressure: number | null = null) => ({ x, y, pressure });
const kinds = (commands: Command[]) => commands.map(({ kind }) => kind);

describe("brush tool", () => {
  it("CM5: begins, moves and ends a stroke under one number", () => {
    const { tool, sent } = setUp();
    tool.begin(at(0, 1000));
    tool.tick();
    tool.move([at(10, 990)]);
    tool.end();
    expect(kinds(sent)).toEqual(["stroke_begin", "stroke_move", "stroke_move", "stroke_end"]);
    expect(new Set(sent.map((command) => "stroke" in command && command.stroke))).toEqual(new Set([1]));
  });

  it("is no wider than the picture, drawn or shown", () => {
    const { tool, world, samples, shown } = setUp();
    world.widest = 2.5;
    tool.hover(20, 900);
    expect(shown.at(-1)?.radius).toBe(2.5);
    tool.begin(at(50, 900));
    world.widest = 30;
    tool.tick();
    expect(
      samples().map(({ radius }) => radius),
      "the user may zoom out meanwhile",
    ).toEqual([2.5, 4]);
  });

  it("CM5: draws all copies at once, as strokes that overlap in time", () => {
    const { tool, sent, world, shown } = setUp();
    world.symmetry = { kind: "around", around: 2, mirrored: true };
    tool.begin(at(30, 990));
    tool.move([at(50, 980)]);
    const places = [
      [5, 2, 2],
      [-5, 2, 2],
      [-5, 2, -2],
      [5, 2, -2],
    ];
    const near = (points: readonly (readonly number[])[]) => points.map((point) => point.map((x) => Math.round(x)));
    expect(near(shown.at(-1)!.points), "all are shown while they are drawn").toEqual(places);
    tool.tick();
    tool.end();
    const each = (kind: Command["kind"]) => sent.filter((command) => command.kind === kind);
    expect(kinds(sent).slice(0, 4)).toEqual(Array(4).fill("stroke_begin"));
    expect(kinds(sent).slice(-4)).toEqual(Array(4).fill("stroke_end"));
    expect(new Set(each("stroke_begin").map((command) => "stroke" in command && command.stroke)).size).toBe(4);
    const moves = each("stroke_move").slice(0, 4);
    expect(near(moves.map((move) => (move as { samples: StrokeSample[] }).samples.at(-1)!.position))).toEqual(places);
  });

  it("winds around the tree that turns under it", () => {
    const { tool, world, samples, shown } = setUp();
    tool.begin(at(600, 500));
    for (let i = 0; i < 12; i++) {
      world.turned = (i * 2 * Math.PI) / 12;
      // The finger rises a little, and then rests.
      tool.move([at(600, 500 - 10 * i)]);
      tool.tick();
    }
    const rested = samples().length;
    world.turned += 0.5;
    tool.tick();
    const places = samples().map(({ position }) => position);
    const angles = places.map(([x, , z]) => Math.atan2(-z, x - 50));
    const radii = places.map(([x, , z]) => Math.hypot(x - 50, z));
    expect(places.length).toBe(rested + 1);
    expect(Math.max(...radii) - Math.min(...radii)).toBeLessThan(1e-2);
    expect(new Set(angles.map((angle) => Math.round((angle * 2) / Math.PI))).size).toBeGreaterThanOrEqual(4);
    expect(shown.at(-1)?.point).toEqual(places.at(-1));
  });

  it("gathers all places since the last message", () => {
    const { tool, sent } = setUp();
    tool.begin(at(0, 900));
    tool.move([at(10, 900), at(20, 900)]);
    tool.move([at(30, 900)]);
    expect(kinds(sent)).toEqual(["stroke_begin"]);
    tool.tick();
    expect(sent[1]).toMatchObject({ samples: [0, 1, 2, 3].map((x) => ({ position: [x, 10, 2] })) });
  });

  it("shows where it is before anything is sent, each copy of it, until the command that ends it", () => {
    const { tool, sent, world, ghosts } = setUp();
    world.symmetry = { kind: "around", around: 2, mirrored: false };
    world.unsettled = 99;
    tool.begin(at(30, 990));
    tool.move([at(50, 980)]);
    expect(kinds(sent)).toEqual(["stroke_begin", "stroke_begin"]);
    expect(ghosts.filter(Boolean).map(({ places }) => places.at(-1)!.map(Math.round))).toEqual([
      [5, 2, 2],
      [-5, 2, -2],
    ]);
    tool.end();
    expect(ghosts.filter(Boolean).map(({ ended }) => ended && sent[ended - 1]?.kind)).toEqual([
      "stroke_end",
      "stroke_end",
    ]);
    tool.begin(at(30, 990));
    tool.abandon();
    expect(ghosts).toEqual([]);
  });

  it("a resting brush keeps sowing", () => {
    const { tool, samples } = setUp();
    tool.begin(at(50, 900));
    for (let i = 0; i < 5; i++) tool.tick();
    expect(samples()).toEqual(Array(5).fill({ position: [5, 10, 2], radius: 4 }));
  });

  it("a tap sows once", () => {
    const { tool, sent } = setUp();
    tool.begin(at(50, 900));
    tool.end();
    expect(kinds(sent)).toEqual(["stroke_begin", "stroke_move", "stroke_end"]);
  });

  it("draws at the depth of the branch it began on", () => {
    const { tool, world, samples } = setUp();
    world.branch = [1, 2, -7];
    tool.begin(at(0, 900));
    world.branch = [1, 2, 30];
    tool.move([at(100, 900)]);
    tool.end();
    expect(samples().map(({ position }) => position[2])).toEqual([-7, -7]);
  });

  it("carries the radius of the moment, even at rest", () => {
    const { tool, world, samples, shown } = setUp();
    tool.begin(at(0, 900));
    tool.tick();
    world.radius = 0;
    tool.tick();
    world.radius = 9;
    tool.move([at(100, 900)]);
    tool.end();
    expect(samples().map(({ radius }) => radius)).toEqual([4, 0, 9]);
    expect(shown).toEqual([]);
  });

  it("holds back while many messages are under way, and drops nothing", () => {
    const { tool, world, sent, samples } = setUp();
    tool.begin(at(0, 900));
    world.unsettled = 8;
    for (let i = 1; i <= 700; i++) {
      tool.move([at(i * 2, 900)]);
      tool.tick();
    }
    expect(kinds(sent)).toEqual(["stroke_begin"]);
    world.unsettled = 0;
    tool.tick();
    tool.end();
    expect(samples().map(({ position }) => position[0])).toEqual(Array.from({ length: 701 }, (_, i) => i / 5));
  });

  it("LM2: no message has more than 256 places", () => {
    const { tool, sent } = setUp();
    tool.begin(at(0, 900));
    tool.move(Array.from({ length: 1000 }, (_, i) => at(i * 3, 900)));
    tool.end();
    for (const command of sent) {
      expect(command.kind !== "stroke_move" || command.samples.length <= 256).toBe(true);
    }
    expect(sent.length).toBe(6);
  });

  it("thins places that crowd but keeps the last", () => {
    const { tool, samples } = setUp();
    tool.begin(at(0, 900));
    tool.move(Array.from({ length: 1000 }, (_, i) => at(i / 100, 900)));
    tool.end();
    const xs = samples().map(({ position }) => position[0]);
    expect(xs[xs.length - 1]).toBe(0.999);
    expect(xs.length).toBeLessThanOrEqual(1 / MIN_SPACING + 1);
  });

  it("LM2: stays within reach and above the ground", () => {
    const { tool, samples } = setUp();
    tool.begin(at(-1e9, 1e9));
    tool.move([at(1e9, -1e9)]);
    tool.end();
    expect(samples().map(({ position }) => position)).toEqual([
      [-1000, 0, 2],
      [1000, 1000, 2],
    ]);
  });

  it("a pen's pressure widens the brush only where that is on", () => {
    const { tool, world, samples } = setUp();
    tool.begin(at(0, 900, 1));
    world.pressure = true;
    tool.move([at(50, 900, 1)]);
    world.radius = 40;
    tool.move([at(150, 900, 1)]);
    tool.end();
    expect(samples().map(({ radius }) => radius)).toEqual([4, 7.2, 40]);
  });

  it("every sample carries the radius its own pressure gave", () => {
    const { tool, world, samples } = setUp();
    world.pressure = true;
    tool.begin(at(0, 900, 0.5));
    tool.move(Array.from({ length: 30 }, (_, i) => at(20 * (i + 1), 900, 0.1)));
    tool.end();
    const radii = samples().map(({ radius }) => radius);
    expect(radii[0]).toBe(4);
    expect(radii.every((radius, i) => i === 0 || radius <= radii[i - 1]!)).toBe(true);
    expect(radii[30]).toBeLessThan(1.1);
  });

  it("SG1: names the branch that alone may grow when it begins", () => {
    const { tool, world, sent } = setUp();
    world.bud = 17;
    tool.begin(at(0, 900));
    world.bud = null;
    tool.end();
    tool.begin(at(0, 900));
    expect(sent.filter(({ kind }) => kind === "stroke_begin")).toEqual([
      { kind: "stroke_begin", stroke: 1, bud: 17 },
      { kind: "stroke_begin", stroke: 4 },
    ]);
  });

  it("a view without a plane costs places, not the stroke", () => {
    const { tool, world, sent } = setUp();
    world.planes = false;
    tool.begin(at(0, 900));
    tool.tick();
    tool.end();
    expect(kinds(sent)).toEqual(["stroke_begin", "stroke_end"]);
  });

  it("says nothing more of a stroke the server has lost", () => {
    const { tool, sent } = setUp();
    tool.begin(at(0, 900));
    tool.abandon();
    tool.tick();
    tool.move([at(5, 5)]);
    tool.end();
    expect(kinds(sent)).toEqual(["stroke_begin"]);
  });

  it("hovering shows the brush and sends nothing", () => {
    const { tool, sent, shown } = setUp();
    tool.hover(20, 900);
    expect([sent, shown]).toMatchObject([[], [{ point: [2, 10, 2], radius: 4 }]]);
  });
});
