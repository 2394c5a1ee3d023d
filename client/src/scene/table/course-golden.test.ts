import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { type Twig, tableOf } from "../../../test/small-tree";
import { MIN_RADIUS, RADIUS_LOG_STEP } from "../../wire/generated";
import { LimbCurve } from "./limb-curve";

type Steps = readonly [number, number, number];

interface FittedLimb {
  name: string;
  nodes: Steps[];
  radii: number[];
  offset: Steps;
  bearer: number;
  rises: boolean;
  rounded: boolean;
  places: Steps[];
  directions: Steps[];
}

/** Parent, whether an axis begins, place in 256ths, code of the radius; then place and direction as drawn, arc and radius. */
type DrawnRow = [number | null, boolean, Steps, number, Steps, Steps, [number, number]];

interface DrawnTree {
  name: string;
  rows: DrawnRow[];
}

/** What is written down is in steps of so much of an internode. */
const STEPS = 1024;

/** How the server draws wood, which it exports as it is seen here. */
const file = new URL("../../../../server/mesh/golden/course.json", import.meta.url);
const golden = JSON.parse(readFileSync(file, "utf8")) as { limbs: FittedLimb[]; trees: DrawnTree[] };

/** No number is more than a step away: a last bit may round it up here and down there. */
function expectSame(found: ArrayLike<number>, written: readonly Steps[], what: string): void {
  const off = written.flatMap((steps, i) => steps.map((step, axis) => Math.abs(step - STEPS * found[3 * i + axis]!)));
  expect(Math.max(...off), what).toBeLessThan(1);
}

describe("wood that the server draws as well", () => {
  it.each(golden.limbs.map((limb) => [limb.name, limb] as const))("runs along the same curve: %s", (_, limb) => {
    const curve = new LimbCurve();
    curve.reserve(limb.nodes.length);
    curve.count = limb.nodes.length - 1;
    for (const [i, node] of limb.nodes.entries()) {
      for (let axis = 0; axis < 3; axis += 1) curve.given[3 * i + axis] = node[axis]! / STEPS;
      curve.radii[i] = limb.radii[i]! / STEPS;
    }
    const offset = Float64Array.from(limb.offset, (step) => step / STEPS);
    curve.fit(offset, limb.bearer / STEPS, limb.rises, limb.rounded);
    expectSame(curve.places, limb.places, "places");
    expectSame(curve.directions, limb.directions, "directions");
  });

  it.each(golden.trees.map((tree) => [tree.name, tree] as const))("is drawn at the same places: %s", (_, tree) => {
    const twigs = tree.rows.map(([parent, begins, position, code]): Twig => {
      const at = position.map((step) => step / 256) as [number, number, number];
      const radius = MIN_RADIUS * Math.exp((code - 1) * RADIUS_LOG_STEP);
      return parent === null ? { parent: -1, at } : { parent, begins, at, radius };
    });
    const { course, girth, radiusCode, rows } = tableOf(twigs);
    expect([...radiusCode.slice(0, rows)]).toEqual(tree.rows.map(([, , , code]) => code));
    const column = <T>(at: number) => tree.rows.map((row) => row[at] as T);
    expectSame(course.placed, column<Steps>(4), "places");
    expectSame(course.across, column<Steps>(5), "directions");
    for (const [row, [arc, radius]] of column<[number, number]>(6).entries()) {
      expect(Math.abs(arc - STEPS * course.arc[row]!), `length at row ${row}`).toBeLessThan(1);
      // A seed is drawn as thick as its trunk, and has no wood of its own.
      const own = tree.rows[row]![0] === null ? 0 : girth.radius[row]!;
      expect(Math.abs(radius - STEPS * own), `radius of row ${row}`).toBeLessThan(1);
    }
  });

  it("folds in some of them, and is moved", () => {
    const moved = golden.limbs.filter(({ nodes, places }) => JSON.stringify(nodes) !== JSON.stringify(places));
    expect(golden.limbs.length).toBeGreaterThan(20);
    expect(moved.length).toBeGreaterThan(12);
  });
});
