import { useEffect, useRef } from "preact/hooks";
import type { Hindrance, Studio } from "../studio";

const HINDRANCES: Record<Hindrance, { title: string; text: string }> = {
  "unknown-session": {
    title: "This tree is not here",
    text: "The link names a tree this server does not know. It may have been started on another machine.",
  },
  version: {
    title: "This page is of another version",
    text: "The server and this page do not speak the same version, and loading it again did not help. Wait a minute, then reload.",
  },
  "no-server": {
    title: "The server does not answer",
    text: "Is it running, and is this device in the same network? This page keeps trying.",
  },
  "no-webgl": {
    title: "This browser cannot draw in 3D",
    text: "Espalier needs WebGL 2. Try a current Safari, Chrome, Edge or Firefox with graphics acceleration on.",
  },
};

/** What keeps the workspace from being used, and the way on. */
export function HindranceCard({ studio }: { studio: Studio }) {
  const hindrance = studio.hindrance.value;
  if (hindrance === null) {
    return null;
  }
  const { title, text } = HINDRANCES[hindrance];
  return (
    <section class="panel hindrance" role="alert">
      <h2>{title}</h2>
      <p>{text}</p>
      {hindrance === "unknown-session" && (
        <button type="button" class="primary" onClick={() => studio.newSession()}>
          Plant a new tree
        </button>
      )}
      {hindrance === "version" && (
        <button type="button" class="primary" onClick={() => location.reload()}>
          Reload
        </button>
      )}
    </section>
  );
}

/** Short notes that go by themselves. */
export function ToastList({ studio }: { studio: Studio }) {
  const host = useRef<HTMLDivElement>(null);
  const toasts = studio.toasts.list.value;
  // As a popover shown anew with each note, the list lies above a sheet that may be open.
  useEffect(() => {
    const popover = host.current;
    if (!popover?.showPopover) {
      return;
    }
    if (popover.matches(":popover-open")) {
      popover.hidePopover();
    }
    if (toasts.length > 0) {
      popover.showPopover();
    }
  }, [toasts]);
  return (
    <div class="toasts" ref={host} popover="manual" aria-live="polite">
      {toasts.map((toast) => (
        <button type="button" class="toast" key={toast.id} onClick={() => studio.toasts.dismiss(toast.id)}>
          {toast.text}
        </button>
      ))}
    </div>
  );
}

/** The one line a first use needs; it fades once the hand has done it. */
export function Hint({ studio }: { studio: Studio }) {
  const text = hint(studio);
  // The text stays while the line fades.
  const last = useRef("");
  last.current = text ?? last.current;
  return (
    <p class="hint" data-visible={text !== null} aria-hidden={text === null}>
      {last.current}
    </p>
  );
}

function hint(studio: Studio): string | null {
  const { tools, settings } = studio;
  const usable = studio.hindrance.value === null && studio.phase.value === "connected" && !tools.drawing.value;
  if (!usable) {
    return null;
  }
  if (tools.chosen.value === "seed") {
    return "Tap the ground to plant a seed";
  }
  if (tools.chosen.value === "lasso" && tools.outline.shown.value === null && !settings.hasOutlined.value) {
    return "Draw the outline of a crown";
  }
  const untouched = !settings.hasDrawn.value && studio.document.value?.metamers === 0;
  return tools.chosen.value === "brush" && untouched ? "Draw upward from the seedling" : null;
}
