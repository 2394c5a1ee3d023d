import { describe, expect, it } from "vitest";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import type { DrawnObstacle, TriangleMesh } from "../obstacle-meshes";
import { JointMaker, type JointWorker } from "./joint-maker";
import { type JointsMade, type JointTask, JointWork } from "./joint-work";
import { motionRows } from "./motion-rows";
import { firstOf, solidOf } from "./solids";
import { TriangleTree } from "./triangle-tree";

const oak = SWAYING_TREES[0]!;
const rows = motionRows(tableOfSwaying(oak));
const along = [1, 0, 0] as const;

/** A wall across winds along x, so far along x, higher and wider than the tree. */
const wall = (x: number, id = 1): DrawnObstacle => ({
  id,
  shape: { kind: "box", size: [1, 200, 2000] },
  pose: { position: [x, 100, 0] },
});

/** Two triangles in its place. */
const SHEET: TriangleMesh = {
  positions: new Float32Array([0, -100, -1000, 0, 100, -1000, 0, 100, 1000, 0, -100, 1000]),
  triangles: new Uint32Array([0, 1, 2, 0, 2, 3]),
};
const sheet = (x: number, mesh?: TriangleMesh): DrawnObstacle => ({
  id: 2,
  shape: { kind: "mesh", vertices: 4, triangles: 2, scale: 1 },
  pose: { position: [x, 100, 0] },
  ...(mesh ? { mesh } : {}),
});

/** A maker whose worker copies what it is sent, as workers do; and all that it was sent. */
function workshop(): { exposed: (obstacles: readonly DrawnObstacle[]) => Float64Array; sent: JointTask[] } {
  const sent: JointTask[] = [];
  const work = new JointWork();
  const worker: JointWorker = {
    onmessage: null,
    onerror: null,
    postMessage: (task) => {
      sent.push(structuredClone(task));
      worker.onmessage!({ data: work.make(sent.at(-1)!) });
    },
    terminate: () => {},
  };
  let last: JointsMade | null = null;
  const maker = new JointMaker(
    (made) => {
      last = made;
    },
    () => worker,
  );
  maker.make({ grown: { rows, scale: oak, suppleness: 1 }, along, obstacles: [] });
  return {
    sent,
    exposed: (obstacles) => {
      maker.make({ grown: null, along, obstacles });
      return last!.exposure;
    },
  };
}

const meanOf = (of: Float64Array) => of.reduce((sum, each) => sum + each, 0) / of.length;

describe("obstacles in the wind", () => {
  it("take what the formula says from a tree behind them, and nothing from one in front", () => {
    const { exposed } = workshop();
    const open = exposed([]);
    expect(exposed([wall(150)]), "downwind of it").toEqual(open);
    const behind = exposed([wall(-150)]);
    const height = 200 * oak.internodeLength;
    for (const [joint, share] of behind.entries()) {
      const taken = 1 - share / open[joint]!;
      // Its crown is some tens of internodes wide.
      const [near, far] = [100, 200].map((away) => 0.8 * Math.exp((-away * oak.internodeLength) / (10 * height)));
      expect(taken).toBeGreaterThan(far! - 0.01);
      expect(taken).toBeLessThan(near! + 0.01);
    }
  });

  it("count anew as they move, without joints made anew", () => {
    const { exposed, sent } = workshop();
    const shares = [-150, -400, -900, -1500].map((x) => meanOf(exposed([wall(x)])));
    for (const [i, share] of shares.slice(1).entries()) expect(share).toBeGreaterThan(shares[i]!);
    expect(shares.at(-1), "too far away").toBe(meanOf(exposed([])));
    expect(sent.slice(1).every(({ grown }) => grown === null)).toBe(true);
  });

  it("shelter by their triangles once these are here, and those are sent once", () => {
    const { exposed, sent } = workshop();
    const open = exposed([sheet(-150)]);
    expect(open).toEqual(exposed([]));
    const behind = exposed([sheet(-149.5, SHEET)]);
    const behindWall = exposed([wall(-150)]);
    for (const [joint, share] of behind.entries()) expect(share).toBeCloseTo(behindWall[joint]!, 9);
    exposed([sheet(-200, SHEET)]);
    exposed([sheet(-250, SHEET), wall(50)]);
    const carried = sent.map(({ obstacles }) => obstacles.meshes.length);
    expect(carried.reduce((sum, each) => sum + each, 0)).toBe(2);
    // What went away in between is sent again, for the worker has let go of it.
    expect(exposed([sheet(-149.5, SHEET)])).toEqual(behind);
  });

  it("that are planes are land, and shelter nothing", () => {
    const { exposed } = workshop();
    const plane: DrawnObstacle = { id: 1, shape: { kind: "plane" }, pose: { position: [-50, 3, 0] } };
    expect(exposed([plane])).toEqual(exposed([]));
  });
});

describe("triangles in a tree of boxes", () => {
  const draw = (seed: number) => {
    const x = Math.sin(seed * 12.9898) * 43758.5453;
    return x - Math.floor(x) - 0.5;
  };

  it("are met where trying all of them meets one", () => {
    const positions = new Float32Array(9 * 2000).map(
      (_, i) => 20 * draw(Math.floor(i / 9) * 3 + (i % 3) + 1) + 5 * draw(i + 50_000),
    );
    const triangles = new Uint32Array(3 * 2000).map((_, i) => i);
    const tree = new TriangleTree(positions, triangles, 1);
    const alone = Array.from(
      { length: 2000 },
      (_, i) => new TriangleTree(positions, triangles.subarray(3 * i, 3 * i + 3), 1),
    );
    let met = 0;
    for (let ray = 0; ray < 120; ray += 1) {
      const from = new Float64Array(3).map((_, a) => 30 * draw(7 * ray + a));
      const way = new Float64Array(3).map((_, a) => draw(9000 + 3 * ray + a));
      const size = Math.hypot(...way);
      for (let a = 0; a < 3; a += 1) way[a]! /= size;
      const asked = { from, way, reach: 40, up: [0, 1, 0] as const, land: -100 };
      const nearest = alone.reduce((least, each) => Math.min(least, each.first(asked)), Number.POSITIVE_INFINITY);
      expect(tree.first(asked)).toBe(nearest);
      if (nearest < 40) met += 1;
    }
    expect(met).toBeGreaterThan(40);
  });

  it("without an area are none", () => {
    const flat = new TriangleTree(new Float32Array(9), new Uint32Array([0, 1, 2]), 1);
    expect(flat.count).toBe(0);
    const pose = { position: [0, 0, 0] as [number, number, number] };
    const shape = { kind: "mesh", vertices: 3, triangles: 1, scale: 1 } as const;
    expect(solidOf({ shape, pose, triangles: flat }, 0.1)).toBe(null);
    expect(solidOf({ shape: { kind: "sphere", radius: 2 }, pose, triangles: null }, Number.NaN)).toBe(null);
    const ball = solidOf({ shape: { kind: "sphere", radius: 20 }, pose, triangles: null }, 0.1)!;
    expect(ball.height).toBe(2);
    expect(firstOf(ball, [0, 1, 0], [1, 0, 0], 9)).toBeCloseTo(Math.sqrt(3), 12);
    expect(firstOf(ball, [5, 1, 0], [1, 0, 0], 9)).toBe(Number.POSITIVE_INFINITY);
  });
});
