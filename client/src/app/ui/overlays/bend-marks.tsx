import { useRef } from "preact/hooks";
import { pathUp } from "../../../scene/table/branch-rows";
import type { BendTool } from "../../tools/bend/bend-tool";
import type { ToolPage, ToolViewProps } from "../../tools/descriptor";
import { useAnimationFrames } from "../use-animation-frames";

/** What is held of a branch that is bent: its base, the places that stay put, and the way between them. */
export function BendMarks({ tool: bend, page }: ToolViewProps<BendTool>) {
  const host = useRef<SVGGElement>(null);
  const [casing, trace] = [useRef<SVGPathElement>(null), useRef<SVGPathElement>(null)];
  const base = bend.base.value;
  const held = bend.held.value;
  const handles = bend.handles.value.filter((row) => !held.includes(row));
  // Each frame of rows may have moved the branch.
  void page.revision.value;
  const [lowest = null] = held;
  const foot = base ?? (held.length > 1 ? lowest : null);
  const marks = [
    ...(foot === null ? [] : [{ row: foot, kind: "base" }]),
    ...handles.map((row) => ({ row, kind: "pin" })),
    ...held.filter((row) => row !== foot).map((row) => ({ row, kind: "grip" })),
  ];
  useAnimationFrames(marks.length > 0, () => {
    const project = page.stage.projector();
    const place = (row: number) => {
      const at = page.stage.seenAt(row);
      return at ? project?.(at) : null;
    };
    for (const [i, { row }] of marks.entries()) {
      const at = place(row);
      host.current?.children[i]?.setAttribute("transform", at ? `translate(${at[0]} ${at[1]})` : "translate(-99 -99)");
    }
    const way = foot === null ? [] : longest(page, foot, [...held, ...handles]);
    const points = way.flatMap((row) => {
      const at = place(row);
      return at ? [`${at[0].toFixed(1)} ${at[1].toFixed(1)}`] : [];
    });
    const path = points.length > 1 ? `M${points.join("L")}` : "";
    casing.current?.setAttribute("d", path);
    trace.current?.setAttribute("d", path);
  });
  if (marks.length === 0) {
    return null;
  }
  return (
    <svg class="overlay bend-marks" aria-hidden="true">
      <path class="bend-casing" ref={casing} />
      <path class="bend-trace" ref={trace} />
      <g ref={host}>
        {marks.map(({ row, kind }) => (
          <g key={`${kind} ${row}`} class={`bend-${kind}`}>
            <circle class="mark-casing" r={kind === "base" ? 15 : 10} />
            <circle class="mark-ring" r={kind === "base" ? 15 : 10} />
            {kind !== "pin" && <circle class="mark-dot" r="4" />}
            {kind === "base" && <path class="mark-ring" d="M-21 0h-9M21 0h9" />}
          </g>
        ))}
      </g>
    </svg>
  );
}

/** The longest way up from a row to any of some others. */
function longest(page: ToolPage, from: number, rows: readonly number[]): readonly number[] {
  let way: readonly number[] = [];
  for (const row of rows) {
    const path = row > from ? pathUp(page.table, from, row) : null;
    if (path && path.length > way.length) {
      way = path;
    }
  }
  return way;
}
