import { describe, expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { sampleTree } from "../../../test/sample-tree";
import { SMALL, type Twig, tableOf } from "../../../test/small-tree";
import type { ChunkChange } from "../../wire/frame";
import { MIN_RADIUS, RADIUS_LOG_STEP } from "../../wire/generated";
import { LimbCurve } from "./limb-curve";
import type { TreeTable } from "./tree-table";

type Point = [number, number, number];

/** The curve of a limb with these nodes, each as thick as that. */
function curveOf(nodes: readonly Point[], radius: number, rises = false): LimbCurve {
  const curve = new LimbCurve();
  curve.reserve(nodes.length);
  curve.count = nodes.length - 1;
  for (const [i, node] of nodes.entries()) {
    curve.given.set(node, 3 * i);
    curve.radii[i] = radius;
  }
  curve.fit(new Float64Array(3), 0, rises, true);
  return curve;
}

const at = (of: ArrayLike<number>, i: number): Point => [of[3 * i]!, of[3 * i + 1]!, of[3 * i + 2]!];
const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a: Point) => Math.sqrt(dot(a, a));
const angle = (a: Point, b: Point) => Math.acos(Math.min(1, Math.max(-1, dot(a, b) / (length(a) * length(b)))));

/** Curvature times radius, where it is most. */
function tightest(curve: LimbCurve, radius: number): number {
  let most = 0;
  for (let i = 1; i < curve.count; i += 1) {
    const [a, b, c] = [at(curve.places, i - 1), at(curve.places, i), at(curve.places, i + 1)];
    const [before, after] = [minus(b, a), minus(c, b)];
    most = Math.max(most, (angle(before, after) * radius) / (0.5 * (length(before) + length(after))));
  }
  return most;
}

/** A limb that turns at each node by up to so much, in any direction. */
function wandering(random: () => number, count: number, turn: number): Point[] {
  const nodes: Point[] = [[0, 0, 0]];
  let heading: Point = [0, 1, 0];
  for (let i = 0; i < count; i += 1) {
    const [x, y, z] = nodes.at(-1)!;
    const far = 0.7 + 0.6 * random();
    nodes.push([x + far * heading[0], y + far * heading[1], z + far * heading[2]]);
    const helper: Point = Math.abs(heading[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0];
    const side = cross(heading, helper);
    const other = cross(heading, side);
    const [around, by] = [6.283 * random(), turn * random()];
    const out = (axis: number) =>
      (Math.cos(around) * side[axis]!) / length(side) + (Math.sin(around) * other[axis]!) / length(other);
    heading = [0, 1, 2].map((axis) => Math.cos(by) * heading[axis]! + Math.sin(by) * out(axis)) as Point;
  }
  return nodes;
}

function cross(a: Point, b: Point): Point {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

describe("the curve of a limb", () => {
  it("leaves straight wood where it is, however uneven its internodes", () => {
    const nodes = [0, 1, 1.3, 2.6, 3, 4.4, 5, 6].map((y): Point => [0.2 * y, y, -0.1 * y]);
    const curve = curveOf(nodes, 2);
    for (const [i, node] of nodes.entries()) expect(length(minus(at(curve.places, i), node))).toBeLessThan(1e-9);
  });

  it("hardly moves wood that is bent evenly over three of its radii", () => {
    const [radius, bend] = [2, 6];
    const nodes = Array.from({ length: 20 }, (_, i): Point => {
      const turn = i / bend;
      return [bend * (1 - Math.cos(turn)), bend * Math.sin(turn), 0];
    });
    const curve = curveOf(nodes, radius);
    for (let i = 3; i < 17; i += 1) {
      expect(length(minus(at(curve.places, i), nodes[i]!)), `node ${i}`).toBeLessThan(0.03 * radius);
    }
  });

  it("leaves thin wood where it is to the last bit, whatever its corners", () => {
    const nodes = wandering(randoms(2), 30, 2);
    const curve = curveOf(nodes, 0.2);
    expect([...curve.places.slice(0, 93)]).toEqual(nodes.flat());
    // As long as half of its internode, it still has nothing but itself in its window.
    const stout = curveOf(nodes, 0.33);
    expect([...stout.places.slice(0, 93)]).toEqual(nodes.flat());
  });

  it("takes a corner of ninety degrees over more than its radius and a half", () => {
    const nodes = [
      ...Array.from({ length: 21 }, (_, i): Point => [0, i, 0]),
      ...Array.from({ length: 20 }, (_, i): Point => [i + 1, 20, 0]),
    ];
    for (const radius of [0.6, 1, 2, 4]) {
      const curve = curveOf(nodes, radius);
      expect(tightest(curve, radius), `${radius}`).toBeLessThan(0.95);
    }
  });

  it("keeps the rings of crooked wood apart, at any girth", () => {
    const random = randoms(7);
    let [worst, crossings, before] = [0, 0, 0];
    for (let limb = 0; limb < 1500; limb += 1) {
      const radius = 0.3 + 3.7 * random();
      // The thicker wood is, the longer it takes to turn by as much.
      const nodes = wandering(random, 24, Math.min(1.4, 1.1 / radius));
      const curve = curveOf(nodes, radius);
      worst = Math.max(worst, tightest(curve, radius));
      for (let i = 1; i < curve.count; i += 1) {
        const way = minus(at(curve.places, i + 1), at(curve.places, i));
        const [low, high] = [at(curve.directions, i), at(curve.directions, i + 1)];
        const tilt = radius * Math.sin(angle(low, high));
        if (dot(way, low) < tilt && dot(way, high) < tilt) crossings += 1;
        const raw = minus(nodes[i + 1]!, nodes[i]!);
        if (radius * angle(raw, minus(nodes[i]!, nodes[i - 1]!)) > length(raw)) before += 1;
      }
    }
    expect(before, "nodes that would fold").toBeGreaterThan(1000);
    // Where one turn follows upon another at every node, a few are left.
    expect(crossings).toBeLessThan(before / 200);
    expect(worst).toBeLessThan(1.6);
  });

  it("never leaves a node by more than three quarters of its radius, and never an end", () => {
    const random = randoms(9);
    for (let limb = 0; limb < 200; limb += 1) {
      const nodes = wandering(random, 5 + Math.floor(20 * random()), 2.5);
      const radius = 4 * random();
      const curve = curveOf(nodes, radius);
      for (const [i, node] of nodes.entries()) {
        expect(length(minus(at(curve.places, i), node))).toBeLessThanOrEqual(0.75 * radius + 1e-9);
      }
      expect(at(curve.places, 0)).toEqual(nodes[0]);
      expect(at(curve.places, curve.count)).toEqual(nodes.at(-1));
    }
  });

  it("begins where its bearer is drawn, and is at home after three of that one's radii", () => {
    const nodes = Array.from({ length: 9 }, (_, i): Point => [i, 0, 0]);
    const curve = new LimbCurve();
    curve.reserve(9);
    curve.count = 8;
    curve.given.set(nodes.flat());
    curve.radii.fill(0.1, 0, 9);
    curve.fit(Float64Array.of(0, 0.5, 0), 1.5, false, true);
    const heights = Array.from({ length: 9 }, (_, i) => curve.places[3 * i + 1]!);
    expect(heights[0]).toBe(0.5);
    for (let i = 1; i < 5; i += 1) expect(heights[i]!).toBeLessThan(heights[i - 1]!);
    expect(heights.slice(5)).toEqual([0, 0, 0, 0]);
  });

  it("keeps corners where they are wanted", () => {
    const curve = new LimbCurve();
    curve.reserve(3);
    curve.count = 2;
    curve.given.set([0, 0, 0, 0, 1, 0, 1, 1, 0]);
    curve.radii.fill(2);
    curve.fit(new Float64Array(3), 0, false, false);
    expect([...curve.places.slice(0, 9)]).toEqual([0, 0, 0, 0, 1, 0, 1, 1, 0]);
  });
});

/** What is drawn of each living row. */
function drawn({ course, rows, radiusCode, parent }: TreeTable) {
  return Array.from({ length: rows }, (_, row) =>
    radiusCode[row] === 0 && parent[row]! >= 0
      ? []
      : [...course.placed.slice(3 * row, 3 * row + 3), ...course.across.slice(3 * row, 3 * row + 3), course.arc[row]!],
  );
}

/** How far two trees are drawn apart, where it is most. */
function apart(a: TreeTable, b: TreeTable): number {
  const [one, other] = [drawn(a), drawn(b)];
  expect(one.length).toBe(other.length);
  return Math.max(...one.map((numbers, row) => Math.max(0, ...numbers.map((x, i) => Math.abs(x - other[row]![i]!)))));
}

/** A thick trunk with corners (rows 1 to 12), and a limb of its own from row 4 (13 to 20). */
const CORNERED: readonly Twig[] = [
  { parent: -1, at: [0, 0, 0] },
  ...Array.from({ length: 12 }, (_, i): Twig => ({ parent: i, at: [(i % 3) * 0.7, i + 1, 0], radius: 1.2 })),
  ...Array.from(
    { length: 8 },
    (_, i): Twig => ({ parent: i === 0 ? 4 : 12 + i, at: [0.2, 4 + 0.2 * i, i + 1], radius: 0.3, begins: i === 0 }),
  ),
];

function patch(table: TreeTable, change: ChunkChange): void {
  table.apply({ epoch: 1, sequence: table.sequence! + 1, catchUp: true, changes: [change] });
}

describe("the course of a tree", () => {
  it("is its nodes where wood is thin, and beside them where it would fold", () => {
    const thin = tableOf(SMALL.map((twig) => ({ ...twig, radius: 0.1 })));
    expect([...thin.course.placed.slice(0, 3 * thin.rows)]).toEqual([...thin.position.slice(0, 3 * thin.rows)]);
    const thick = tableOf(CORNERED);
    expect([...thick.course.placed.slice(0, 3)]).toEqual([0, 0, 0]);
    expect(thick.course.placed[9]).not.toBe(thick.position[9]);
    const far = (row: number) => length(minus(at(thick.course.placed, row), at(thick.position, row)));
    // Its limb begins beside its bearer's node and comes home.
    expect(far(4)).toBeGreaterThan(0.05);
    expect(far(13)).toBeGreaterThan(0.02);
    expect(far(20)).toBe(0);
  });

  it("is as long from joint to joint as what is drawn", () => {
    const table = tableOf(CORNERED);
    const { placed, arc } = table.course;
    for (let row = 1; row < table.rows; row += 1) {
      const parent = table.parent[row]!;
      const begins = table.limbs.begins[row] === 1 || table.parent[parent]! < 0;
      const way = length(minus(at(placed, row), at(placed, parent)));
      expect(arc[row]! - way, `row ${row}`).toBeCloseTo(begins ? 0 : arc[parent]!, 4);
    }
  });

  it("is the same brought up to date as from nothing", () => {
    const random = randoms(5);
    const twigs = CORNERED.map((twig) => ({ ...twig }));
    const table = tableOf(twigs);
    const code = (radius: number) => 1 + Math.round(Math.log(radius / MIN_RADIUS) / RADIUS_LOG_STEP);
    for (let round = 0; round < 40; round += 1) {
      const row = 1 + Math.floor(random() * (twigs.length - 1));
      if (round % 2 === 0) {
        const radius = 0.1 + 2 * random();
        twigs[row] = { ...twigs[row]!, radius };
        const values = Int32Array.of(code(radius));
        patch(table, { change: "patch", chunk: 0, generation: 2, column: "radius", rows: Uint8Array.of(row), values });
      } else {
        const [x, y, z] = twigs[row]!.at;
        twigs[row] = { ...twigs[row]!, at: [x + 0.5 * random(), y, z] };
        const step = (value: number) => Math.round(256 * value);
        const moved = twigs.flatMap(({ at, parent }, i) =>
          i === row || parent === row ? [{ i, way: at.map((v, a) => step(v) - step(twigs[parent]!.at[a]!)) }] : [],
        );
        const rows = Uint8Array.from(moved, ({ i }) => i);
        const values = Int32Array.from(moved.flatMap(({ way }) => way));
        patch(table, { change: "patch", chunk: 0, generation: 2, column: "position", rows, values });
      }
      // But for what nobody sees.
      expect(apart(table, tableOf(twigs)), `round ${round}`).toBeLessThan(0.06);
    }
  });

  it("is as before when what has grown is taken back", () => {
    const table = tableOf(CORNERED);
    const grown = tableOf([...CORNERED, { parent: 12, at: [3, 12.5, 0], radius: 1 }], tableOf(CORNERED));
    expect(drawn(grown).slice(0, CORNERED.length)).not.toEqual(drawn(table));
    patch(grown, { change: "truncate", rows: CORNERED.length });
    expect(apart(grown, table)).toBeLessThan(0.03);
  });

  it("follows the spread of the foot and the corners that an artist wants", () => {
    const table = tableOf(CORNERED);
    const before = drawn(table);
    expect(table.shape(1, true)).toBe(false);
    expect(table.shape(2, true)).toBe(true);
    expect(drawn(table)).not.toEqual(before);
    table.shape(1, false);
    expect([...table.course.placed.slice(0, 63)]).toEqual([...table.position.slice(0, 63)]);
    table.shape(1, true);
    expect(apart(table, tableOf(CORNERED))).toBeLessThan(0.03);
  });

  it("leaves nearly all of a whole tree where its nodes are", () => {
    const table = tableOf([]);
    table.clear();
    table.apply(sampleTree({ seed: 4, height: 40, orders: 3 }));
    let moved = 0;
    for (let row = 0; row < table.rows; row += 1) {
      if (length(minus(at(table.course.placed, row), at(table.position, row))) > 0.05) moved += 1;
    }
    expect(table.rows).toBeGreaterThan(1000);
    expect(moved).toBeLessThan(0.05 * table.rows);
  });
});
