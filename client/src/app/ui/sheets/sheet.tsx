import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";
import { ToastList } from "../notices/notices";

/** How much of the page a sheet takes, where that is more than usual. */
export type SheetSize = "wide" | "page";

interface SheetProps {
  readonly studio: Studio;
  readonly title: string;
  readonly size?: SheetSize | undefined;
  readonly children: ComponentChildren;
}

/** A modal card over the workspace; Escape, the cross or a tap beside it close it. */
export function Sheet({ studio, title, size, children }: SheetProps) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  const close = () => {
    studio.layout.sheet.value = null;
  };
  return (
    <dialog
      ref={dialog}
      class="sheet"
      data-size={size}
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
      {/* What lies beside a modal card cannot be pressed. */}
      <ToastList studio={studio} />
    </dialog>
  );
}
