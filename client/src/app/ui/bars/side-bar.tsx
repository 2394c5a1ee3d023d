import type { ComponentType } from "preact";
import { useRef, useState } from "preact/hooks";
import type { Studio } from "../../studio";
import type { ToolName } from "../../tools/toolbox";
import { type Key, say } from "../../words/say";
import { FrameIcon, LassoIcon, RedoIcon, SeedIcon, UndoIcon } from "../icons";
import { BendIcon, PruneIcon, TurnIcon, WidthIcon } from "../timeline/timeline-icons";
import { useDismissal } from "../use-dismissal";
import { isSmall } from "../workspace-size";
import { GrowJog } from "./grow-jog";
import { BrushSample, RadiusSlider } from "./radius-slider";

interface ToolButton {
  readonly tool: ToolName;
  readonly label: Key;
  readonly title: Key;
  readonly Icon: ComponentType<{ readonly studio: Studio }>;
}

const TOOLS: readonly ToolButton[] = [
  { tool: "brush", label: "bars.brush", title: "bars.brush.title", Icon: BrushSample },
  { tool: "lasso", label: "bars.lasso", title: "bars.lasso.title", Icon: LassoIcon },
  { tool: "bend", label: "bars.bend", title: "bars.bend.title", Icon: BendIcon },
  { tool: "width", label: "bars.width", title: "bars.width.title", Icon: WidthIcon },
  { tool: "prune", label: "bars.prune", title: "bars.prune.title", Icon: PruneIcon },
  { tool: "branch", label: "bars.branch", title: "bars.branch.title", Icon: TurnIcon },
  { tool: "seed", label: "bars.seed", title: "bars.seed.title", Icon: SeedIcon },
];

/** The tools, at the side of the user that does not draw. */
export function SideBar({ studio }: { studio: Studio }) {
  const document = studio.document.value;
  const small = isSmall();
  return (
    <nav class="panel side-bar" aria-label={say("bars.tools")} data-small={small}>
      {small ? <ToolMenu studio={studio} /> : <Tools studio={studio} />}
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
          data-place="undo"
          aria-label={say("bars.undo")}
          title={say("bars.undo.title")}
          aria-disabled={document?.can_undo !== true}
          onClick={() => studio.undo()}
        >
          <UndoIcon />
        </button>
        <button
          type="button"
          class="tool"
          aria-label={say("bars.redo")}
          title={say("bars.redo.title")}
          aria-disabled={document?.can_redo !== true}
          onClick={() => studio.redo()}
        >
          <RedoIcon />
        </button>
        <button
          type="button"
          class="tool"
          aria-label={say("bars.fit")}
          title={say("bars.fit.title")}
          onClick={() => studio.stage.fitTree()}
        >
          <FrameIcon />
        </button>
      </div>
    </nav>
  );
}

function Tools({ studio, chosen }: { studio: Studio; chosen?: () => void }) {
  return (
    <div class="side-tools">
      {TOOLS.map(({ tool, label, title, Icon }) => (
        <button
          type="button"
          class="tool"
          key={tool}
          aria-label={say(label)}
          title={say(title)}
          aria-pressed={studio.tools.chosen.value === tool}
          onClick={() => {
            studio.tools.choose(tool);
            chosen?.();
          }}
        >
          <Icon studio={studio} />
        </button>
      ))}
    </div>
  );
}

/** Where there is no room for all tools: the chosen one, and the others a tap away. */
function ToolMenu({ studio }: { studio: Studio }) {
  const host = useRef<HTMLDivElement>(null);
  const [open, setOpen] = useState(false);
  useDismissal(host, open, () => setOpen(false));
  const { Icon, label } = TOOLS.find(({ tool }) => tool === studio.tools.chosen.value) ?? TOOLS[0]!;
  return (
    <div class="tool-menu" ref={host}>
      <button
        type="button"
        class="tool folded"
        aria-label={`${say("bars.all-tools")}: ${say(label)}`}
        title={say("bars.all-tools")}
        aria-expanded={open}
        onClick={() => setOpen(!open)}
      >
        <Icon studio={studio} />
      </button>
      {open && (
        <div class="panel flyout">
          <Tools studio={studio} chosen={() => setOpen(false)} />
        </div>
      )}
    </div>
  );
}
