import type { ComponentChildren } from "preact";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";

interface PanelProps {
  readonly studio: Studio;
  readonly title: string;
  readonly children: ComponentChildren;
}

/** A card pulled down beside the workspace, which shrinks and stays in use. */
export function Panel({ studio, title, children }: PanelProps) {
  return (
    <section class="panel drawer" aria-label={title}>
      <header>
        <h2>{title}</h2>
        <button
          type="button"
          class="tool"
          aria-label={say("bars.close-panel", { panel: title })}
          title={say("bars.close-panel.title")}
          onClick={() => {
            studio.layout.panel.value = null;
          }}
        >
          <CloseIcon />
        </button>
      </header>
      <div class="drawer-body">{children}</div>
    </section>
  );
}
