import { useRef, useState } from "preact/hooks";
import type { Studio } from "../../studio";
import { descriptorOf, TOOL_NAMES } from "../../tools/tools";
import { say } from "../../words/say";
import { FrameIcon, RedoIcon, UndoIcon } from "../icons";
import { useDismissal } from "../use-dismissal";
import { isSmall } from "../workspace-size";
import { GrowJog } from "./grow-jog";
import { RadiusSlider } from "./radius-slider";

/** The tools, at the side of the user that does not draw; who only looks has the one that finds the tree again. */
export function SideBar({ studio }: { studio: Studio }) {
  if (!studio.rights.mayChange.value) {
    return (
      <nav class="panel side-bar" aria-label={say("bars.tools")} data-small="true">
        <FitButton studio={studio} />
      </nav>
    );
  }
  const small = isSmall(studio.settings.namesShown.value);
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
          aria-disabled={!studio.undo.may("undo")}
          onClick={() => studio.undo.undo()}
        >
          <UndoIcon />
        </button>
        <button
          type="button"
          class="tool"
          aria-label={say("bars.redo")}
          title={say("bars.redo.title")}
          aria-disabled={!studio.undo.may("redo")}
          onClick={() => studio.undo.redo()}
        >
          <RedoIcon />
        </button>
        <FitButton studio={studio} />
      </div>
    </nav>
  );
}

function FitButton({ studio }: { studio: Studio }) {
  return (
    <button
      type="button"
      class="tool"
      data-place="fit"
      aria-label={say("bars.fit")}
      title={say("bars.fit.title")}
      onClick={() => studio.stage.fitTree()}
    >
      <FrameIcon />
    </button>
  );
}

function Tools({ studio, chosen }: { studio: Studio; chosen?: () => void }) {
  return (
    <div class="side-tools">
      {TOOL_NAMES.map((tool) => {
        const { label, title, key, Icon } = descriptorOf(tool);
        return (
          <button
            type="button"
            class="tool"
            key={tool}
            aria-label={say(label)}
            title={`${say(title)} (${key})`}
            aria-pressed={studio.tools.chosen.value === tool}
            onClick={() => {
              studio.tools.choose(tool);
              chosen?.();
            }}
          >
            <Icon settings={studio.settings} />
          </button>
        );
      })}
    </div>
  );
}

/** Where there is no room for all tools: the chosen one, and the others a tap away. */
function ToolMenu({ studio }: { studio: Studio }) {
  const host = useRef<HTMLDivElement>(null);
  const [open, setOpen] = useState(false);
  useDismissal(host, open, () => setOpen(false));
  const { Icon, label } = descriptorOf(studio.tools.chosen.value);
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
        <Icon settings={studio.settings} />
      </button>
      {open && (
        <div class="panel flyout">
          <Tools studio={studio} chosen={() => setOpen(false)} />
        </div>
      )}
    </div>
  );
}
