import type { Studio } from "../studio";
import { GrowJog } from "./grow-jog";
import { FrameIcon, LassoIcon, RedoIcon, SeedIcon, UndoIcon } from "./icons";
import { BrushSample, RadiusSlider } from "./radius-slider";

const TOOLS = [
  { tool: "brush", label: "Brush", title: "Brush: the tree grows into the stroke (B)" },
  { tool: "lasso", label: "Lasso", title: "Lasso: draw the outline the tree grows to fill (L)" },
  { tool: "seed", label: "Plant a seed", title: "Plant a seed: tap the ground (P)" },
] as const;

/** The tools, at the side of the hand that does not draw. */
export function SideBar({ studio }: { studio: Studio }) {
  const document = studio.document.value;
  return (
    <nav class="panel side-bar" aria-label="Tools">
      <div class="side-tools">
        {TOOLS.map(({ tool, label, title }) => (
          <button
            type="button"
            class="tool"
            key={tool}
            aria-label={label}
            title={title}
            aria-pressed={studio.tools.chosen.value === tool}
            onClick={() => studio.tools.choose(tool)}
          >
            {tool === "brush" ? <BrushSample studio={studio} /> : tool === "lasso" ? <LassoIcon /> : <SeedIcon />}
          </button>
        ))}
      </div>
      <hr />
      <RadiusSlider studio={studio} />
      <hr />
      <GrowJog studio={studio} />
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
