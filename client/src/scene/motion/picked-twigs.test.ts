import { Matrix4, PerspectiveCamera } from "three";
import { expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { type Projection, pickBranch } from "../camera/picking";
import { radiusOf } from "../table/tree-table";
import { Answers } from "./answers";
import { JointWork } from "./joint-work";
import { motionRows } from "./motion-rows";
import { swayedPlace } from "./places";
import { pose, STAND } from "./pose";
import { Riding } from "./riding";
import { Sway } from "./sway";
import { LIVE_PERIOD, windOf } from "./wind";

const TWIGS = 20;
/** Pixels by which a finger may miss. */
const TOLERANCE = 12;

function sight(middle: number, distance: number): Projection {
  const camera = new PerspectiveCamera(32, 1200 / 800, 0.1, 10_000);
  camera.position.set(0, middle, distance);
  camera.lookAt(0, middle, 0);
  camera.updateMatrixWorld();
  return {
    clipFromWorld: new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements,
    width: 1200,
    height: 800,
    pixelsPerInternode: 800 / (2 * Math.tan((16 * Math.PI) / 180)),
  };
}

function onScreen({ clipFromWorld: m, width, height }: Projection, p: ArrayLike<number>): [number, number, number] {
  const at = (r: number) => m[r]! * p[0]! + m[r + 4]! * p[1]! + m[r + 8]! * p[2]! + m[r + 12]!;
  return [(width / 2) * (1 + at(0) / at(3)), (height / 2) * (1 - at(1) / at(3)), at(3)];
}

it("a twig that moves in the wind is met where it is seen, each time", () => {
  const tree = SWAYING_TREES[1]!;
  const table = tableOfSwaying(tree);
  const rows = motionRows(table);
  const grown = { rows, scale: tree, suppleness: tree.suppleness };
  const made = new JointWork().make({ grown, along: [1, 0, 0], obstacles: { standing: [], meshes: [] } });
  const moving = made.moving!;
  const riding = new Riding(moving, rows.parent, rows.quantised);
  const wind = windOf({ velocity: [8, 0, 0], turbulence: 0.7, seed: 7 }, LIVE_PERIOD);
  const sway = new Sway(new Answers(moving.joints, wind, made.exposure));
  const bends = new Float64Array(3 * moving.joints.count);
  const stands = new Float64Array(STAND * moving.joints.count);
  const { min, max } = table.bounds();
  const view = sight((min[1] + max[1]) / 2, 2 * (max[1] - min[1]));
  const random = randoms(11);
  const twigs = Array.from({ length: table.rows }, (_, row) => row).filter(
    (row) => table.parent[row]! >= 0 && table.radiusCode[row] !== 0 && table.successor[row]! < 0,
  );
  let moved = 0;
  for (let i = 0; i < TWIGS; i += 1) {
    sway.bends(3.7 * i, bends);
    pose(moving.hinges, bends, stands);
    const placeOf = swayedPlace(stands, riding, null);
    const twig = twigs[Math.floor(random() * twigs.length)]!;
    const [x, y] = onScreen(view, placeOf(table, twig));
    const pick = pickBranch(table, view, x, y, TOLERANCE, { placeOf, hides: () => false });
    expect(pick, `twig ${twig}`).not.toBeNull();
    const [a, b, depth] = onScreen(view, pick!.point);
    const radius = (radiusOf(table.radiusCode[pick!.row]!) * view.pixelsPerInternode) / depth;
    expect(Math.hypot(a - x, b - y), `twig ${twig} is under the finger`).toBeLessThan(TOLERANCE + radius);
    const { placed } = table.course;
    const [restX, restY] = onScreen(view, placed.subarray(3 * twig, 3 * twig + 3));
    if (Math.hypot(restX - x, restY - y) > 1) moved += 1;
  }
  expect(moved, "of twigs that are not where they grew").toBeGreaterThan(TWIGS / 2);
});
