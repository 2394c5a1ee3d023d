import { useRef, useState } from "preact/hooks";
import { isUsual } from "../../../scene/mode/shown";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Icon } from "../icons";
import { DRAW_MODE_LIST } from "../parts";
import { useDismissal } from "../use-dismissal";

/** Chooses what is shown of the tree: how it looks, how it is built, or a number that each part has; and what of the picture is left out. */
export function DrawModeMenu({ studio }: { studio: Studio }) {
  const host = useRef<HTMLDivElement>(null);
  const [open, setOpen] = useState(false);
  useDismissal(host, open, () => setOpen(false));
  const mode = studio.drawMode.value;
  const List = DRAW_MODE_LIST.content.value;
  return (
    <div class="tool-menu" ref={host}>
      <button
        type="button"
        class="tool"
        data-place="draw-modes"
        aria-label={say("drawmode.menu")}
        title={say("drawmode.menu.title")}
        aria-expanded={open}
        aria-pressed={mode !== "lit" || !isUsual(studio.settings.shown.value)}
        onClick={() => {
          setOpen(!open);
          void DRAW_MODE_LIST.open();
        }}
      >
        <DrawModeIcon />
      </button>
      {open && List && (
        <List
          mode={mode}
          shown={studio.settings.shown}
          choose={(name) => {
            setOpen(false);
            studio.drawMode.value = name;
          }}
        />
      )}
    </div>
  );
}

/** Half in the light, half as a net. */
const DrawModeIcon = () => (
  <Icon>
    <circle cx="12" cy="12" r="8" />
    <path d="M12 4a8 8 0 0 1 0 16Z" fill="currentColor" stroke="none" opacity="0.32" />
    <path d="M12 4v16M4.6 9h7.4M4.6 15H12M8 5.200c-1.6 4-1.6 9.6 0 13.6" stroke-width="1.3" />
  </Icon>
);
