import { type CameraView, FIELD_OF_VIEW } from "../../../scene/camera/camera-view";
import type { ViewCamera } from "../../../scene/camera/view-camera";
import type { Vec3 } from "../../../scene/vector";
import { handlesOf } from "../../document/design/branch-handles";
import type { BranchShape } from "../../document/design/branch-shape";
import { ROOT } from "../../document/design/design-model";
import type { Studio } from "../../studio";

/** So much of the picture at its foot the bar lies over, where it is not there yet. */
const COVERED = 0.2;
/** How much of the picture lies around what is looked at: half its height and a little. */
const ROOM = 0.62;
/** Nothing is looked at from nearer than so that this many internodes are seen. */
const LEAST_SPAN = 1.5;

/** Looks at a branch from where all its handles are in sight above the bar, and lie apart. */
export function comeTo(studio: Studio, shape: BranchShape | null): void {
  if (!shape) {
    return;
  }
  const places = [...shape.axis(), ...handlesOf(shape).map((handle) => handle.place(shape))];
  const bound = (of: (...parts: number[]) => number): Vec3 => [
    of(...places.map(([x]) => x)),
    of(...places.map(([, y]) => y)),
    of(...places.map(([, , z]) => z)),
  ];
  const [min, max] = [bound(Math.min), bound(Math.max)];
  const camera = studio.stage.view?.camera;
  if (shape.path === ROOT) {
    camera?.fitBox({ min, max }, covered());
  } else if (camera) {
    camera.visit(nearby(min, max, camera, covered()));
  }
  studio.stage.moved();
}

/** From the side that the picture shows now, but so near that a branch up in the tree fills it. */
function nearby(min: Vec3, max: Vec3, { rig, sight }: ViewCamera, hidden: number): CameraView {
  const half = Math.tan(FIELD_OF_VIEW / 2);
  const [across, up, deep] = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
  const width = Math.hypot(across, deep);
  const wanted = ROOM * Math.max(up / half, width / (half * (sight.width / sight.height)), LEAST_SPAN / half);
  const distance = (wanted + width / 2) / (1 - hidden);
  const { yaw, pitch } = rig.view;
  const target: [number, number, number] = [
    (min[0] + max[0]) / 2,
    (min[1] + max[1]) / 2 - hidden * distance * half,
    (min[2] + max[2]) / 2,
  ];
  return { target, yaw, pitch, distance };
}

function covered(): number {
  const bar = document.querySelector<HTMLElement>(".structure-bar");
  const height = bar?.offsetParent?.clientHeight ?? 0;
  return bar && height > 0 ? Math.min(1 - bar.offsetTop / height, 0.5) : COVERED;
}
