import { useEffect, useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { descriptorOf } from "../../tools/tools";
import { say } from "../../words/say";
import { GoOn } from "./go-on-button";

/** What keeps the workspace from being used, and the way on. */
export function HindranceCard({ studio }: { studio: Studio }) {
  const hindrance = studio.hindrance.value;
  if (hindrance === null) {
    return null;
  }
  return (
    <section class="panel hindrance" role="alert" data-hindrance={hindrance}>
      <h2>{say(`notices.${hindrance}`)}</h2>
      <p>{hindrance === "cannot-open" ? studio.link.refusal.value : say(`notices.${hindrance}.text`)}</p>
      {(hindrance === "unknown-session" || hindrance === "cannot-open" || hindrance === "only-look") && (
        <WayToTrees studio={studio} />
      )}
      {hindrance === "cannot-open" && studio.link.waits.value && studio.rights.mayResume && (
        <GoOn studio={studio} look="" then={() => location.reload()} />
      )}
      {(hindrance === "version" || hindrance === "no-picture") && (
        <button type="button" class="primary" onClick={() => location.reload()}>
          {say("notices.reload")}
        </button>
      )}
    </section>
  );
}

/** Where there is no tree: to a new one, or for whoever begins none to those there are. */
function WayToTrees({ studio }: { studio: Studio }) {
  const begins = studio.rights.mayBegin;
  const act = () => {
    if (begins) {
      void studio.trees.leave();
    } else {
      studio.layout.sheet.value = "library";
    }
  };
  return (
    <button type="button" class="primary" onClick={act}>
      {say(begins ? "notices.unknown-session.way" : "notices.only-look.way")}
    </button>
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
      {toasts.map(({ id, text, action }) => (
        <div class="toast-row" key={id}>
          <button type="button" class="toast" onClick={() => studio.toasts.dismiss(id)}>
            {text}
          </button>
          {action && (
            <button
              type="button"
              class="toast-action"
              onClick={() => {
                studio.toasts.dismiss(id);
                action.act();
              }}
            >
              {action.label}
            </button>
          )}
        </div>
      ))}
    </div>
  );
}

/** The one line a first use needs; it fades once the user has done it. */
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
  const usable =
    studio.hindrance.value === null &&
    studio.rights.mayChange.value &&
    studio.link.phase.value === "connected" &&
    !tools.drawing.value &&
    // A legend has its place, and its lesson.
    studio.drawMode.value === "lit" &&
    studio.tour.step.value === null;
  if (!usable) {
    return null;
  }
  const text = descriptorOf(tools.chosen.value).hint?.({
    settings,
    outlined: studio.outline.shown.value !== null,
    empty: studio.document.value?.metamers === 0,
  });
  return text ? say(text) : null;
}
