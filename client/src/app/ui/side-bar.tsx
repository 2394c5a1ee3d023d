import type { Studio } from "../studio";
import { GrowJog } from "./grow-jog";
import { FrameIcon, RedoIcon, UndoIcon } from "./icons";
import { RadiusSlider } from "./radius-slider";

/** The tools, at the side of the hand that does not draw. */
export function SideBar({ studio }: { studio: Studio }) {
  const document = studio.document.value;
  return (
    <nav class="panel side-bar" aria-label="Tools">
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
          onClick={() => studio.frameTree()}
        >
          <FrameIcon />
        </button>
      </div>
    </nav>
  );
}
