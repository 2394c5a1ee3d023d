import type { ComponentType } from "preact";
import type { Studio } from "../studio";
import type { ToolName } from "../tools/toolbox";
import { GrowJog } from "./grow-jog";
import { FrameIcon, LassoIcon, RedoIcon, SeedIcon, UndoIcon } from "./icons";
import { BrushSample, RadiusSlider } from "./radius-slider";
import { BendIcon, PruneIcon, TurnIcon, WidthIcon } from "./timeline-icons";

interface ToolButton {
  readonly tool: ToolName;
  readonly label: string;
  readonly title: string;
  readonly Icon: ComponentType<{ readonly studio: Studio }>;
}

const TOOLS: readonly ToolButton[] = [
  { tool: "brush", label: "Brush", title: "Brush: the tree grows into the stroke (B)", Icon: BrushSample },
  { tool: "lasso", label: "Lasso", title: "Lasso: draw the outline the tree grows to fill (L)", Icon: LassoIcon },
  { tool: "bend", label: "Bend", title: "Bend: hold a branch's base and drag its end (N)", Icon: BendIcon },
  { tool: "width", label: "Width", title: "Width: pinch around a limb, or tap it (W)", Icon: WidthIcon },
  { tool: "prune", label: "Prune", title: "Prune: tap branches, or draw a line through them (X)", Icon: PruneIcon },
  { tool: "branch", label: "Branch", title: "Branch: turn, move and copy whole branches (T)", Icon: TurnIcon },
  { tool: "seed", label: "Plant a seed", title: "Plant a seed: tap the ground (P)", Icon: SeedIcon },
];

/** The tools, at the side of the hand that does not draw. */
export function SideBar({ studio }: { studio: Studio }) {
  const document = studio.document.value;
  return (
    <nav class="panel side-bar" aria-label="Tools">
      <div class="side-tools">
        {TOOLS.map(({ tool, label, title, Icon }) => (
          <button
            type="button"
            class="tool"
            key={tool}
            aria-label={label}
            title={title}
            aria-pressed={studio.tools.chosen.value === tool}
            onClick={() => studio.tools.choose(tool)}
          >
            <Icon studio={studio} />
          </button>
        ))}
      </div>
      <hr />
      <div class="side-levers">
        <RadiusSlider studio={studio} />
        <GrowJog studio={studio} />
      </div>
      <hr />
      <div class="side-buttons">
        <button
          type="button"
          class="tool"
          aria-label="Undo"
          title="Undo (Ctrl Z)"
          aria-disabled={document?.can_undo !== true}
          onClick={() => studio.undo()}
        >
          <UndoIcon />
        </button>
        <button
          type="button"
          class="tool"
          aria-label="Redo"
          title="Redo (Shift Ctrl Z)"
          aria-disabled={document?.can_redo !== true}
          onClick={() => studio.redo()}
        >
          <RedoIcon />
        </button>
        <button
          type="button"
          class="tool"
          aria-label="Show the whole tree"
          title="Show the whole tree (F)"
          onClick={() => studio.stage.frameTree()}
        >
          <FrameIcon />
        </button>
      </div>
    </nav>
  );
}
