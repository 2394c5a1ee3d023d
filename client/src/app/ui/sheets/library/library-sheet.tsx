import { useEffect, useMemo, useRef } from "preact/hooks";
import * as api from "../../../library/library-api";
import { said } from "../../../library/save-tree";
import { Shelf } from "../../../library/shelf";
import { SHELF_NAMES } from "../../../page/layout";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { UnsavedSection } from "../unsaved-section";
import { DeletedCard } from "./deleted-card";
import { neighbour } from "./grid-keys";
import { More } from "./more";
import { SelectionBar } from "./selection-bar";
import { SpeciesTemplates } from "./species-templates";
import { TreeCard } from "./tree-card";

/** The library: its trees, templates, and what was deleted; a tap opens a tree. */
export function LibrarySheet({ studio }: { studio: Studio }) {
  const { shelf: shown, sheet } = studio.layout;
  const name = shown.value;
  const shelf = useMemo(
    () =>
      new Shelf({
        name,
        api,
        said: () => said(studio),
        show: (text, action) => studio.toasts.show(text, action),
      }),
    [studio, name],
  );
  useEffect(() => {
    void shelf.pages.next();
    // Nobody sees any more how far the work is.
    return () => shelf.work.cancel();
  }, [shelf]);
  useEffect(
    () => () => {
      // Whoever comes back from the versions of a tree finds the shelf as it was.
      if (sheet.peek() !== "versions") {
        shown.value = "trees";
      }
    },
    [sheet, shown],
  );
  const trees = shelf.pages.items.value;
  const choosing = shelf.chosen.value !== null;
  return (
    <div class="shelf">
      <div class="shelf-bar">
        <fieldset class="segments" aria-label={say("library.shelves")}>
          {SHELF_NAMES.map((one) => (
            <label key={one}>
              <input
                type="radio"
                name="shelf"
                checked={one === name}
                onChange={() => {
                  shown.value = one;
                }}
              />
              <span>{say(`library.shelf.${one}`)}</span>
            </label>
          ))}
        </fieldset>
        {trees !== null && trees.length > 0 && (
          <button
            type="button"
            class="small"
            aria-pressed={choosing}
            onClick={() => {
              shelf.chosen.value = choosing ? null : new Set();
            }}
          >
            {say(choosing ? "library.select.end" : "library.select")}
          </button>
        )}
      </div>
      {name === "trees" && <UnsavedSection studio={studio} />}
      {trees?.length === 0 && <p class="quiet empty">{say(`library.empty.${name}`)}</p>}
      <Grid studio={studio} shelf={shelf} />
      <More pages={shelf.pages} />
      {name === "templates" && <SpeciesTemplates studio={studio} />}
      <SelectionBar shelf={shelf} />
    </div>
  );
}

/** The trees in pictures; arrows lead from one to the next, Delete deletes. */
function Grid({ studio, shelf }: { readonly studio: Studio; readonly shelf: Shelf }) {
  const list = useRef<HTMLUListElement>(null);
  const trees = shelf.pages.items.value ?? [];
  const onKeyDown = (event: KeyboardEvent) => {
    const buttons = [...(list.current?.querySelectorAll<HTMLElement>("button.card-open") ?? [])];
    const at = buttons.indexOf(event.target as HTMLElement);
    const tree = trees[at];
    if (tree === undefined) {
      return;
    }
    const next = neighbour(buttons, at, event.key);
    if (next !== null) {
      event.preventDefault();
      next.focus();
    } else if (event.key === "Delete" && shelf.name !== "deleted") {
      // The one that takes its place is at hand next.
      (buttons[at + 1] ?? buttons[at - 1])?.focus();
      void shelf.remove(shelf.chosenTrees.length > 0 ? shelf.chosenTrees : [tree]);
    }
  };
  return (
    <ul class="library" ref={list} onKeyDown={onKeyDown}>
      {trees.map((tree) =>
        shelf.name === "deleted" && shelf.chosen.value === null ? (
          <DeletedCard key={tree.id} shelf={shelf} tree={tree} />
        ) : (
          <TreeCard key={tree.id} studio={studio} shelf={shelf} tree={tree} />
        ),
      )}
    </ul>
  );
}
