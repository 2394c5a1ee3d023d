import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";

interface SheetProps {
  readonly studio: Studio;
  readonly title: string;
  readonly wide?: boolean | undefined;
  readonly children: ComponentChildren;
}

/** A modal card over the workspace; Escape, the cross or a tap beside it close it. */
export function Sheet({ studio, title, wide = false, children }: SheetProps) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  const close = () => {
    studio.layout.sheet.value = null;
  };
  return (
    <dialog
      ref={dialog}
      class={wide ? "sheet wide" : "sheet"}
      aria-label={title}
      onClose={close}
      onKeyDown={(event) => {
        // A field would take the first Escape for itself, as one that searches does to become empty.
        if (event.key === "Escape" && !event.defaultPrevented && !event.isComposing) {
          event.preventDefault();
          close();
        }
      }}
      onPointerDown={(event) => {
        if (event.target === event.currentTarget) {
          close();
        }
      }}
    >
      <div class="sheet-body">
        <header>
          <h2>{title}</h2>
          <button type="button" class="tool" aria-label={say("bars.close")} onClick={close}>
            <CloseIcon />
          </button>
        </header>
        {children}
      </div>
    </dialog>
  );
}
