import { bench, describe } from "vitest";
import { sampleTree } from "../../../test/sample-tree";
import { PruneRule } from "../../app/tools/prune/prune-rule";
import { TreeTable } from "../table/tree-table";
import { CALM } from "./air-settings";
import { Answers } from "./answers";
import { JointWork } from "./joint-work";
import { motionRows } from "./motion-rows";
import { pose, STAND } from "./pose";
import { Riding } from "./riding";
import { brokenBy } from "./strain";
import { Sway } from "./sway";
import { windOf } from "./wind";

const SCALE = { internodeLength: 0.1, leafSize: 1 };
const HARSH = { ...CALM, speed: 20, turbulence: 0.8, snow: 0.5 };
const WEATHER = { velocity: [7, 0, 3], turbulence: 0.7, seed: 7 } as const;

/** Trees of about ten and a hundred thousand rows. */
const TREES = [
  { seed: 3, height: 62, orders: 3 },
  { seed: 3, height: 96, orders: 4 },
];

for (const options of TREES) {
  const table = new TreeTable(() => 0);
  table.apply(sampleTree(options));
  const order = () => ({ grown: { rows: motionRows(table), scale: SCALE, suppleness: 1 }, along: [1, 0, 0] as const });
  const work = new JointWork();
  const { moving, exposure } = work.make(order());
  const { joints, hinges } = moving!;
  const answers = () => new Answers(joints, windOf(WEATHER, 600), exposure);
  const sway = new Sway(answers());
  const bends = new Float64Array(3 * joints.count);
  const stands = new Float64Array(STAND * joints.count);
  const { parent, quantised } = motionRows(table);
  const riding = new Riding(moving!, parent, quantised);
  const rows = motionRows(table);
  const broken = brokenBy({ rows, scale: SCALE, air: HARSH });
  let time = 0;

  describe(`${table.rows} rows, ${joints.count} joints`, () => {
    bench("joints made anew, in the worker", () => {
      work.make(order());
    });
    bench("shelter for another direction, in the worker", () => {
      work.make({ grown: null, along: [0, 0, 1] });
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
      brokenBy({ rows, scale: SCALE, air: HARSH });
    });
    bench("what would break: rows copied for the worker", () => {
      motionRows(table);
    });
    bench("what would break: where it comes off", () => {
      new PruneRule(table, new Set()).cutsAtAll(broken);
    });
  });
}
