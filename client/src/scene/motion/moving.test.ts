import { describe, expect, it } from "vitest";
import { type Twig, tableOf } from "../../../test/small-tree";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import type { TreeTable } from "../table/tree-table";
import { JointMaker, type JointOrder, type JointWorker } from "./joint-maker";
import { type JointsMade, JointWork } from "./joint-work";
import { motionRows } from "./motion-rows";
import { type Moving, PHASE, PIVOT, ROW_NUMBERS } from "./moving";
import { restingPlace, swayedPlace } from "./places";
import { pose, STAND } from "./pose";
import { WEIGHT } from "./rides";
import { Riding } from "./riding";

const SCALE = { internodeLength: 0.1, leafSize: 1 };
/** No obstacles, as a worker gets them. */
const NOTHING = { standing: [], meshes: [] };

function orderOf(table: TreeTable, suppleness = 1): JointOrder {
  return { grown: { rows: motionRows(table), scale: SCALE, suppleness }, along: [1, 0, 0], obstacles: [] };
}

function movingOf(table: TreeTable): Moving {
  return new JointWork().make({ ...orderOf(table), obstacles: NOTHING }).moving!;
}

function ridingOf(table: TreeTable, moving: Moving): Riding {
  const { parent, quantised } = motionRows(table);
  return new Riding(moving, parent, quantised);
}

/** A thin trunk of so many metamers, which sways. */
const trunk = (rows: number): readonly Twig[] =>
  Array.from({ length: rows }, (_, y) => ({ parent: y - 1, at: [0, y, 0] as const, radius: 0.03 }));

describe("joints made beside the page", () => {
  const oak = tableOfSwaying(SWAYING_TREES[3]!);

  it("say for each row what it rides on and shivers with", () => {
    const { rows, rowCount, joints, hinges, loads } = movingOf(oak);
    expect(rowCount).toBe(oak.rows);
    expect(hinges.count).toBe(joints.count);
    expect(loads.sag.every(Number.isFinite)).toBe(true);
    let shivers = 0;
    for (let row = 0; row < rowCount; row += 1) {
      const at = ROW_NUMBERS * row;
      expect(rows[at]).toBeLessThan(joints.count);
      if (rows[at + PHASE]! < 0) continue;
      shivers += 1;
      const parent = ROW_NUMBERS * oak.parent[row]!;
      // A twig is one whole: all of it shivers about where it stands.
      if (rows[parent + PHASE]! >= 0) {
        expect(rows.slice(at + PIVOT, at + PIVOT + 4)).toEqual(rows.slice(parent + PIVOT, parent + PIVOT + 4));
      }
    }
    expect(shivers).toBeGreaterThan(0);
  });

  it("hang lower under their own weight", () => {
    const lying: readonly Twig[] = [
      ...trunk(2).map((twig) => ({ ...twig, radius: 1 })),
      ...Array.from({ length: 20 }, (_, i) => ({
        parent: i === 0 ? 1 : i + 1,
        at: [i + 1, 1, 0] as const,
        radius: 0.05,
        begins: i === 0,
      })),
    ];
    const { loads, hinges, joints } = movingOf(tableOf(lying));
    const bends = new Float64Array(3 * joints.count).map((_, i) => loads.sag[i]!);
    const stands = new Float64Array(STAND * joints.count);
    pose(hinges, bends, stands);
    const table = tableOf(lying);
    const seen = swayedPlace(stands, ridingOf(table, movingOf(table)), null);
    expect(seen(table, 21)[1]).toBeLessThan(1);
  });

  it("are made on the page where there is no worker, and where it dies", () => {
    const made: JointsMade[] = [];
    const none = new JointMaker(
      (each) => made.push(each),
      () => {
        throw new Error("no workers here");
      },
    );
    none.make(orderOf(oak));
    expect(made[0]!.moving!.rowCount).toBe(oak.rows);
    expect(none.busy).toBe(false);

    const worker: JointWorker = { onmessage: null, onerror: null, postMessage: () => {}, terminate: () => {} };
    const dying = new JointMaker(
      (each) => made.push(each),
      () => worker,
    );
    dying.make(orderOf(oak));
    expect(dying.busy).toBe(true);
    worker.onerror!();
    expect(made[1]!.exposure).toEqual(made[0]!.exposure);
    dying.make({ grown: null, along: [0, 0, 1], obstacles: [] });
    expect(made[2]!.moving).toBe(null);
    expect(made[2]!.exposure.length).toBe(made[0]!.exposure.length);
  });

  it("answer nothing where there were none before", () => {
    expect(new JointWork().make({ grown: null, along: [1, 0, 0], obstacles: NOTHING }).exposure.length).toBe(0);
  });
});

describe("rows that have changed since", () => {
  it("go on as those below them", () => {
    const table = tableOf(trunk(8));
    const riding = ridingOf(table, movingOf(table));
    expect(riding.follow(table)).toBe(null);
    const before = riding.rows.slice(0, ROW_NUMBERS * 8);
    const grown = tableOf(trunk(300));
    expect(riding.follow(grown)).toBe(8);
    expect(riding.count).toBe(300);
    expect(riding.rows.slice(0, ROW_NUMBERS * 8)).toEqual(before);
    const weight = (row: number) => riding.rows[ROW_NUMBERS * row + WEIGHT];
    expect(weight(299)).toBe(weight(7));
    expect(riding.rows[ROW_NUMBERS * 299]).toBe(riding.rows[ROW_NUMBERS * 7]);
    expect(riding.follow(grown)).toBe(null);
  });

  it("ride as the same joints would have them where nothing but a place has changed", () => {
    const straight = trunk(8);
    const moved = straight.map((twig, y) => (y > 4 ? { ...twig, at: [1, y, 0] as const } : twig));
    const riding = ridingOf(tableOf(straight), movingOf(tableOf(straight)));
    expect(riding.follow(tableOf(moved))).toBe(5);
    riding.follow(tableOf(straight));
    const fresh = ridingOf(tableOf(straight), movingOf(tableOf(straight)));
    for (const [i, number] of riding.rows.entries()) expect(number).toBeCloseTo(fresh.rows[i]!, 5);
  });

  it("ride on nothing once they are seeds", () => {
    const table = tableOf(trunk(8));
    const riding = ridingOf(table, movingOf(table));
    const seeds = tableOf(trunk(8).map((twig) => ({ ...twig, parent: -1 })));
    expect(riding.follow(seeds)).toBe(1);
    for (let row = 0; row < 8; row += 1) expect(riding.rows[ROW_NUMBERS * row]).toBe(-1);
  });
});

describe("a branch that is picked while it sways", () => {
  it("is met where it is seen, and held where it is at rest", () => {
    const table = tableOf(trunk(12));
    const moving = movingOf(table);
    const stands = new Float64Array(STAND * moving.joints.count);
    pose(moving.hinges, Float64Array.of(0, 0, -0.4), stands);
    const seen = swayedPlace(stands, ridingOf(table, moving), null);
    expect(seen(table, 11)[0]).toBeGreaterThan(1);
    const [a, b] = [seen(table, 10), seen(table, 11)];
    const middle = [0, 1, 2].map((axis) => 0.5 * (a[axis]! + b[axis]!)) as [number, number, number];
    const rest = restingPlace(table, { row: 11, point: middle }, seen, null);
    for (const [axis, place] of [0, 10.5, 0].entries()) expect(rest[axis]).toBeCloseTo(place, 5);
  });
});
