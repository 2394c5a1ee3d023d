import { bench, describe } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { PruneRule } from "../../app/tools/prune/prune-rule";
import type { DrawnObstacle, TriangleMesh } from "../obstacle-meshes";
import { CALM } from "./air-settings";
import { Answers } from "./answers";
import { JointWork } from "./joint-work";
import { motionRows } from "./motion-rows";
import { ObstaclePost } from "./obstacle-post";
import { pose, STAND } from "./pose";
import { Riding } from "./riding";
import { StrainWork } from "./strain";
import { Sway } from "./sway";
import { windOf } from "./wind";

const SCALE = { internodeLength: 0.1, leafSize: 1 };
const HARSH = { ...CALM, speed: 20, turbulence: 0.8, snow: 0.5 };
const NOTHING = { standing: [], meshes: [] };
const WEATHER = { velocity: [7, 0, 3], turbulence: 0.7, seed: 7 } as const;

/** Trees of about ten and a hundred thousand rows; with `HUGE=1` one of a million instead, which takes a minute to make. */
const TREES = process.env.HUGE
  ? [{ seed: 3, height: 160, orders: 4 }]
  : [
      { seed: 3, height: 62, orders: 3 },
      { seed: 3, height: 96, orders: 4 },
    ];

/** A rough rock as large as a tree and close in front of it, of as many triangles as a model may have. */
const ROCK = rock(256, 256);
const MODEL = {
  id: 1,
  shape: { kind: "mesh", vertices: ROCK.positions.length / 3, triangles: ROCK.triangles.length / 3, scale: 1 },
  pose: { position: [-60, 30, 0] },
  mesh: ROCK,
} as const satisfies DrawnObstacle;

function rock(rings: number, sides: number): TriangleMesh {
  const [positions, triangles] = [[] as number[], [] as number[]];
  for (let ring = 0; ring <= rings; ring += 1) {
    for (let side = 0; side < sides; side += 1) {
      const [down, around] = [(Math.PI * ring) / rings, (2 * Math.PI * side) / sides];
      const size = 40 + 3 * Math.sin(9 * around) * Math.sin(7 * down);
      const [sin, cos] = [Math.sin(down), Math.cos(down)];
      positions.push(size * sin * Math.cos(around), size * cos, size * sin * Math.sin(around));
      if (ring === rings) continue;
      const at = (r: number, s: number) => r * sides + (s % sides);
      const [a, b, c, d] = [at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1)];
      triangles.push(a, b, c, b, d, c);
    }
  }
  return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}

for (const options of TREES) {
  const table = new PlainTable(() => 0);
  table.apply(sampleTree(options));
  const order = () => ({
    grown: { rows: motionRows(table), scale: SCALE, suppleness: 1 },
    along: [1, 0, 0] as const,
    obstacles: NOTHING,
  });
  const work = new JointWork();
  const post = new ObstaclePost();
  const strain = new StrainWork();
  const strainPost = new ObstaclePost();
  const { moving, exposure } = work.make(order());
  const { joints, hinges } = moving!;
  const answers = () => new Answers(joints, windOf(WEATHER, 600), exposure);
  const sway = new Sway(answers());
  const bends = new Float64Array(3 * joints.count);
  const stands = new Float64Array(STAND * joints.count);
  const { parent, quantised } = motionRows(table);
  const riding = new Riding(moving!, parent, quantised);
  const rows = motionRows(table);
  const broken = strain.broken({ rows, scale: SCALE, air: HARSH, obstacles: NOTHING });
  let time = 0;

  describe(`${table.rows} rows, ${joints.count} joints`, () => {
    bench("joints made anew, in the worker", () => {
      work.make(order());
    });
    bench("shelter for another direction, in the worker", () => {
      work.make({ grown: null, along: [0, 0, 1], obstacles: NOTHING });
    });
    bench("the same behind a model of 131,072 triangles", () => {
      work.make({ grown: null, along: [1, 0, 0], obstacles: post.post([MODEL]) });
    });
    bench("the same as it comes", () => {
      work.make({
        grown: null,
        along: [1, 0, 0],
        obstacles: post.post([{ ...MODEL, mesh: { ...ROCK } }]),
      });
    });
    bench("answers to a new wind", () => {
      answers();
    });
    bench("a frame: bends of all joints, and how they stand", () => {
      time += 1 / 60;
      sway.bends(time, bends);
      pose(hinges, bends, stands);
    });
    bench("rows taken over that have changed", () => {
      riding.follow(table);
    });
    bench("what would break in a storm and snow, in its worker", () => {
      strain.broken({ rows, scale: SCALE, air: HARSH, obstacles: NOTHING });
    });
    bench("the same behind that model", () => {
      strain.broken({ rows, scale: SCALE, air: HARSH, obstacles: strainPost.post([MODEL]) });
    });
    bench("what would break: rows copied for the worker", () => {
      motionRows(table);
    });
    bench("what would break: where it comes off", () => {
      new PruneRule(table, new Set()).cutsAtAll(broken);
    });
  });
}
