import { useMemo, useRef } from "preact/hooks";
import { axisStart, branchRows } from "../../../scene/table/branch-rows";
import type { Vec3 } from "../../../scene/vector";
import type { Studio } from "../../studio";
import { useAnimationFrames } from "../use-animation-frames";

/** Metamers of a branch that are traced; a marked limb is known by less than all its twigs. */
const MOST_TRACED = 500;

/** Where the branch is that alone grows: a ring at the place that was held, and the branch itself traced. */
export function BudMarker({ studio }: { studio: Studio }) {
  const ring = useRef<SVGGElement>(null);
  const [casing, trace] = [useRef<SVGPathElement>(null), useRef<SVGPathElement>(null)];
  const row = studio.bud.row.value;
  const { table } = studio;
  // Each frame of rows may have added to the branch.
  const revision = studio.revision.value;
  const segments = useMemo(() => (row === null ? [] : branchRows(table, row, MOST_TRACED)), [row, table, revision]);
  useAnimationFrames(row !== null, () => {
    const project = studio.stage.projector();
    const place = row === null ? null : project?.(positionOf(row));
    ring.current?.setAttribute("transform", place ? `translate(${place[0]} ${place[1]})` : "translate(-99 -99)");
    let path = "";
    for (const metamer of segments) {
      const parent = table.parent[metamer] ?? -1;
      const [from, to] = parent < 0 ? [null, null] : [project?.(positionOf(parent)), project?.(positionOf(metamer))];
      if (from && to) {
        path += `M${from[0].toFixed(1)} ${from[1].toFixed(1)}L${to[0].toFixed(1)} ${to[1].toFixed(1)}`;
      }
    }
    casing.current?.setAttribute("d", path);
    trace.current?.setAttribute("d", path);
  });
  if (row === null) {
    return null;
  }
  function positionOf(at: number): Vec3 {
    const { placed } = table.course;
    return [placed[3 * at] ?? 0, placed[3 * at + 1] ?? 0, placed[3 * at + 2] ?? 0];
  }
  return (
    <svg class="overlay bud" aria-hidden="true">
      <path class="bud-casing" ref={casing} />
      <path class="bud-trace" ref={trace} />
      <g ref={ring} key={axisStart(table, row)}>
        <circle class="bud-wave" r="15" />
        <circle class="bud-wave late" r="15" />
        <circle class="bud-ring-casing" r="13" />
        <circle class="bud-ring" r="13" />
        <circle class="bud-dot" r="3.5" />
      </g>
    </svg>
  );
}

/** A ring that fills around a finger as long as it is held. */
export function HoldRing({ studio }: { studio: Studio }) {
  const hold = studio.tools.hold.value;
  if (hold === null) {
    return null;
  }
  return (
    <svg class="overlay hold" aria-hidden="true">
      <g transform={`translate(${hold.x} ${hold.y}) rotate(-90)`}>
        <circle class="hold-track" r="34" />
        <circle class="hold-fill" r="34" pathLength={1} style={{ "--milliseconds": `${hold.milliseconds}ms` }} />
      </g>
    </svg>
  );
}
