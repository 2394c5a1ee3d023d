import { useEffect, useMemo, useRef } from "preact/hooks";
import * as api from "../../../library/library-api";
import { LibrarySection } from "../../../library/library-section";
import { said } from "../../../library/save-tree";
import { SECTION_NAMES } from "../../../page/layout";
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
  const { section: shown, sheet } = studio.layout;
  const name = shown.value;
  const section = useMemo(
    () =>
      new LibrarySection({
        name,
        api,
        said: () => said(studio),
        show: (text, action) => studio.toasts.show(text, action),
      }),
    [studio, name],
  );
  useEffect(() => {
    void section.pages.next();
    // Nobody sees any more how far the work is.
    return () => section.work.cancel();
  }, [section]);
  useEffect(
    () => () => {
      // Whoever comes back from the versions of a tree finds the section as it was.
      if (sheet.peek() !== "versions") {
        shown.value = "trees";
      }
    },
    [sheet, shown],
  );
  const trees = section.pages.items.value;
  const choosing = section.chosen.value !== null;
  return (
    <div class="library-sections">
      <div class="library-bar">
        <fieldset class="segments" aria-label={say("library.sections")}>
          {SECTION_NAMES.map((one) => (
            <label key={one}>
              <input
                type="radio"
                name="section"
                checked={one === name}
                onChange={() => {
                  shown.value = one;
                }}
              />
              <span>{say(`library.section.${one}`)}</span>
            </label>
          ))}
        </fieldset>
        {trees !== null && trees.length > 0 && (
          <button
            type="button"
            class="small"
            aria-pressed={choosing}
            onClick={() => {
              section.chosen.value = choosing ? null : new Set();
            }}
          >
            {say(choosing ? "library.select.end" : "library.select")}
          </button>
        )}
      </div>
      {name === "trees" && <UnsavedSection studio={studio} />}
      {trees?.length === 0 && <p class="quiet empty">{say(`library.empty.${name}`)}</p>}
      <Grid studio={studio} section={section} />
      <More pages={section.pages} />
      {name === "templates" && <SpeciesTemplates studio={studio} />}
      <SelectionBar section={section} />
    </div>
  );
}

/** The trees in pictures; arrows lead from one to the next, Delete deletes. */
function Grid({ studio, section }: { readonly studio: Studio; readonly section: LibrarySection }) {
  const list = useRef<HTMLUListElement>(null);
  const trees = section.pages.items.value ?? [];
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
    } else if (event.key === "Delete" && section.name !== "deleted") {
      // The one that takes its place is at hand next.
      (buttons[at + 1] ?? buttons[at - 1])?.focus();
      void section.remove(section.chosenTrees.length > 0 ? section.chosenTrees : [tree]);
    }
  };
  return (
    <ul class="library" ref={list} onKeyDown={onKeyDown}>
      {trees.map((tree) =>
        section.name === "deleted" && section.chosen.value === null ? (
          <DeletedCard key={tree.id} section={section} tree={tree} />
        ) : (
          <TreeCard key={tree.id} studio={studio} section={section} tree={tree} />
        ),
      )}
    </ul>
  );
}
