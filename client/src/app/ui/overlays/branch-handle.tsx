import type { ComponentChildren } from "preact";
import { useMemo, useRef } from "preact/hooks";
import { subtreeRows } from "../../../scene/table/branch-rows";
import { type BranchTool, RING } from "../../tools/branch/branch-tool";
import type { ToolViewProps } from "../../tools/descriptor";
import { say } from "../../words/say";
import { Icon } from "../icons";
import { GraftIcon, PruneIcon } from "../shaping-icons";
import { TimeIcon } from "../timeline/timeline-icons";
import { useAnimationFrames } from "../use-animation-frames";

/** Room the menu needs below the ring, in pixels, and beside its middle. */
const MENU_BELOW = 62;
const MENU_HALF = 150;
const EDGE = 12;

/** Metamers of the branch that are traced; a limb is known by less than all its twigs. */
const MOST_TRACED = 400;

/** Two like branches. */
const CopyIcon = () => (
  <Icon>
    <path d="M7.500 20.500v-9M7.500 14.500 4 11M7.500 12l3-3.500" />
    <path d="M16.500 16.500v-9M16.500 10.500 13 7M16.500 8l3-3.500" stroke-dasharray="2.200 2.400" />
  </Icon>
);

/** The ring at the base of the branch that is held, and what can be done with it. */
export function BranchHandle({ page }: ToolViewProps<BranchTool>) {
  const [ring, menu] = [useRef<SVGGElement>(null), useRef<HTMLDivElement>(null)];
  const [casing, trace] = [useRef<SVGPathElement>(null), useRef<SVGPathElement>(null)];
  const { held: branch } = page.branches;
  const row = branch.row.value;
  const placing = branch.placing.value;
  // Each frame of rows may have moved it, or added to it.
  const revision = page.revision.value;
  const predicted = page.branches.prediction.rows.value !== null;
  const menuShown = placing === null && !branch.turning.value;
  const { table } = page;
  const traced = useMemo(() => (row === null ? [] : subtreeRows(table, row, MOST_TRACED)), [row, table, revision]);
  useAnimationFrames(row !== null && !predicted, () => {
    const base = branch.base();
    const project = page.stage.projector();
    const place = base && project?.(base);
    let path = "";
    for (const metamer of traced) {
      const [from, to] = [table.parent[metamer] ?? -1, metamer].map((at) =>
        project?.(page.branches.ghosts.placeOf(at)),
      );
      if (from && to) {
        path += `M${from[0].toFixed(1)} ${from[1].toFixed(1)}L${to[0].toFixed(1)} ${to[1].toFixed(1)}`;
      }
    }
    casing.current?.setAttribute("d", path);
    trace.current?.setAttribute("d", path);
    ring.current?.setAttribute("transform", place ? `translate(${place[0]} ${place[1]})` : "translate(-99 -99)");
    const host = menu.current;
    const workspace = host?.parentElement;
    if (host && workspace && place) {
      const x = Math.min(workspace.clientWidth - MENU_HALF - EDGE, Math.max(MENU_HALF + EDGE, place[0]));
      const low = workspace.clientHeight - MENU_BELOW - 130;
      const y = place[1] + MENU_BELOW > low ? place[1] - MENU_BELOW - host.offsetHeight : place[1] + MENU_BELOW;
      host.style.transform = `translate(${x}px, ${Math.max(EDGE, y)}px) translateX(-50%)`;
    }
  });
  if (row === null || predicted) {
    return null;
  }
  return (
    <>
      <svg class="overlay branch-handle" data-placing={placing !== null} aria-hidden="true">
        <path class="bud-casing" ref={casing} />
        <path class="branch-trace" ref={trace} />
        <g ref={ring}>
          <circle class="branch-ring-casing" r={RING - 12} />
          <circle class="branch-ring" r={RING - 12} />
          <path class="branch-arrow" d="M-5-42 7-34-5-26ZM5 42-7 34 5 26Z" />
          <circle class="branch-dot" r="4" />
        </g>
      </svg>
      {menuShown && (
        <div class="panel branch-menu" ref={menu} role="toolbar" aria-label={say("tools.branch")}>
          <MenuButton
            label={say("tools.branch.move")}
            title={say("tools.branch.move.title")}
            act={() => page.branches.place("move")}
          >
            <GraftIcon />
          </MenuButton>
          <MenuButton
            label={say("tools.branch.copy")}
            title={say("tools.branch.copy.title")}
            act={() => page.branches.place("copy")}
          >
            <CopyIcon />
          </MenuButton>
          <MenuButton
            label={say("tools.branch.cut")}
            title={say("tools.branch.cut.title")}
            act={() => page.branches.cut()}
          >
            <PruneIcon />
          </MenuButton>
          <MenuButton
            label={say("tools.what-if")}
            title={say("tools.branch.predict.title")}
            act={() => page.branches.predictCut()}
          >
            <TimeIcon />
          </MenuButton>
        </div>
      )}
    </>
  );
}

interface MenuButtonProps {
  readonly label: string;
  readonly title: string;
  readonly act: () => void;
  readonly children: ComponentChildren;
}

function MenuButton({ label, title, act, children }: MenuButtonProps) {
  return (
    <button type="button" title={title} onClick={act}>
      {children}
      {label}
    </button>
  );
}
