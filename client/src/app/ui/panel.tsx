import type { ComponentChildren } from "preact";
import type { Studio } from "../studio";
import { CloseIcon } from "./icons";

interface PanelProps {
  readonly studio: Studio;
  readonly title: string;
  readonly children: ComponentChildren;
}

/** A card pulled down beside the workspace, which stays in use. */
export function Panel({ studio, title, children }: PanelProps) {
  return (
    <section class="panel drawer" aria-label={title}>
      <header>
        <h2>{title}</h2>
        <button
          type="button"
          class="tool"
          aria-label={`Close ${title}`}
          title="Close (Esc)"
          onClick={() => {
            studio.panel.value = null;
          }}
        >
          <CloseIcon />
        </button>
      </header>
      <div class="drawer-body">{children}</div>
    </section>
  );
}
