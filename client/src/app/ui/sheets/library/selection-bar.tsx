import { say } from "../../../words/say";
import type { LibraryDesk } from "./library-desk";
import { placesIn } from "./move-form";

/** What the choice of a collection says before one is chosen; no collection has such an id. */
const UNMOVED = " ";

/** Keys go on from there, for the button that began to choose has gone. */
function focused(button: HTMLButtonElement | null): void {
  if (document.activeElement === document.body) {
    button?.focus({ preventScroll: true });
  }
}

/** What is done with the chosen trees, in sight wherever the list is scrolled to; while it is done, how far it is. */
export function SelectionBar({ desk: { section, catalogue, studio } }: { readonly desk: LibraryDesk }) {
  const progress = section.work.progress.value;
  const chosen = section.chosen.value;
  if (progress !== null && progress.total !== null && progress.total > 1) {
    const text = say("library.working", { done: progress.bytes, total: progress.total });
    return (
      <div class="selection-bar">
        <label>
          <span>{text}</span>
          <progress max={progress.total} value={progress.bytes} aria-label={text} />
        </label>
        <button type="button" class="small" onClick={() => section.work.cancel()}>
          {say("library.stop")}
        </button>
      </div>
    );
  }
  if (chosen === null) {
    return null;
  }
  const trees = section.chosenTrees;
  const none = trees.length === 0;
  return (
    <div class="selection-bar" role="toolbar" aria-label={say("library.selection")}>
      <span role="status">{none ? say("library.choose-some") : say("library.chosen", { count: trees.length })}</span>
      <button
        type="button"
        class="small primary"
        ref={focused}
        onClick={() => {
          section.chosen.value = null;
        }}
      >
        {say("library.select.end")}
      </button>
      <div class="selection-deeds">
        {section.name === "deleted" ? (
          <button type="button" class="small" disabled={none} onClick={() => void section.takeBack(trees)}>
            {say("library.take-back")}
          </button>
        ) : (
          <>
            <button type="button" class="small" disabled={none} onClick={() => void section.duplicate(trees)}>
              {say("library.duplicate")}
            </button>
            <select
              class="pick"
              aria-label={say("finding.move.chosen")}
              disabled={none}
              value={UNMOVED}
              onChange={({ currentTarget }) => {
                const to = catalogue.folder(currentTarget.value) ?? null;
                currentTarget.value = UNMOVED;
                void section.move(trees, to);
              }}
            >
              <option value={UNMOVED} disabled>
                {say("finding.move")}
              </option>
              {placesIn(catalogue.folders.value ?? []).map(([id, name]) => (
                <option value={id} key={id}>
                  {name}
                </option>
              ))}
            </select>
            <button
              type="button"
              class="small"
              disabled={none}
              onClick={() => void section.mark(trees, section.name === "trees")}
            >
              {say(section.name === "trees" ? "library.mark" : "library.unmark")}
            </button>
            {studio.rights.mayDelete && (
              <button type="button" class="small danger" disabled={none} onClick={() => void section.remove(trees)}>
                {say("library.delete")}
              </button>
            )}
          </>
        )}
      </div>
    </div>
  );
}
