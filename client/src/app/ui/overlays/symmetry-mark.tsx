import { useRef } from "preact/hooks";
import type { Vec3 } from "../../../scene/vector";
import type { Studio } from "../../studio";
import { symmetryNow } from "../../tools/symmetry/stroke-copies";
import { copiesOf, type SymmetryCentre } from "../../tools/symmetry/symmetry";
import { useAnimationFrames } from "../use-animation-frames";

/** How far the axis reaches above the tree, and how long it is at least, in internodes. */
const ABOVE = 3;
const LEAST_HEIGHT = 12;
/** How far the rays on the ground reach, in internodes. */
const RAY = 6;

/** What strokes are repeated about: the axis through the trunk and, around it, the borders of the sectors on the ground. */
export function SymmetryMark({ studio }: { studio: Studio }) {
  const path = useRef<SVGPathElement>(null);
  useAnimationFrames(true, () => {
    const project = studio.stage.projector();
    const lines = project ? linesOf(studio).map((line) => line.map(project)) : [];
    const drawn = lines.flatMap(([from, to]) =>
      from && to ? `M${from[0].toFixed(1)} ${from[1].toFixed(1)}L${to[0].toFixed(1)} ${to[1].toFixed(1)}` : [],
    );
    path.current?.setAttribute("d", drawn.join(""));
  });
  return (
    <svg class="overlay symmetry" aria-hidden="true">
      <path ref={path} />
    </svg>
  );
}

function linesOf(studio: Studio): (readonly [Vec3, Vec3])[] {
  const centre = studio.tools.centre.peek() ?? idleCentre(studio);
  const symmetry = symmetryNow(studio.settings, studio.bud.row.peek());
  const [x, , z] = centre.foot;
  const height = Math.max(LEAST_HEIGHT, studio.table.bounds().max[1] + ABOVE);
  const axis: readonly [Vec3, Vec3] = [centre.foot, [x, height, z]];
  if (symmetry.kind !== "around") {
    return [axis];
  }
  // Along the mirror, where there is one; else no direction is better than another.
  const [rx, , rz] = symmetry.mirrored ? centre.mirrorNormal : [0, 0, 1];
  const turns = copiesOf({ ...symmetry, mirrored: false }, centre);
  const rays = turns.map(({ direction }) => {
    const [dx, , dz] = direction([-rz * RAY, 0, rx * RAY]);
    return [centre.foot, [x + dx, 0, z + dz]] as const;
  });
  return [axis, ...rays];
}

/** What the next stroke would be repeated about: the plant in the middle of the picture. */
function idleCentre(studio: Studio): SymmetryCentre {
  const { base, right } = studio.stage.middle();
  return { foot: base, mirrorNormal: right };
}
