import { useEffect, useMemo } from "preact/hooks";
import { conditions } from "../../../library/wanted";
import { SECTION_NAMES, type SheetName } from "../../../page/layout";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { UnsavedSection } from "../unsaved-section";
import { Collections } from "./collections";
import { FinderBar } from "./finder-bar";
import { FoundBy, NothingFound } from "./found-by";
import { type LibraryDesk, openDesk } from "./library-desk";
import { More } from "./more";
import { OpenFile } from "./open-file";
import { SelectionBar } from "./selection-bar";
import { SpeciesTemplates } from "./species-templates";
import { DragGhost } from "./tree-drag";
import { TreeGrid } from "./tree-grid";

/** Sheets about one thing of the library, from which one comes back to it. */
const ABOUT_ONE: ReadonlySet<SheetName | null> = new Set(["versions", "share", "gifts", "variations"] as const);

/** The library: its trees, templates, and what was deleted, and ways to find them; a tap opens a tree. */
export function LibrarySheet({ studio }: { studio: Studio }) {
  const { section: shown, sheet } = studio.layout;
  const name = shown.value;
  const desk = useMemo(() => openDesk(studio, name), [studio, name]);
  const { section, catalogue, wanted } = desk;
  const want = wanted.value;
  useEffect(() => void section.pages.anew(), [section, want]);
  const { rights } = studio;
  const isOpen = rights.onlyTree.value === null;
  useEffect(() => {
    if (isOpen) {
      void catalogue.refresh();
    }
    // Nobody sees any more how far the work is.
    return () => section.work.cancel();
  }, [section, catalogue, isOpen]);
  useEffect(
    () => () => {
      // Whoever comes back from a sheet about one thing of it finds the section as it was.
      if (!ABOUT_ONE.has(sheet.peek())) {
        shown.value = "trees";
      }
    },
    [sheet, shown],
  );
  const isNarrowed = want.collection !== null || conditions({ ...want, words: "" }, String).length > 0;
  const isFound = section.pages.items.value?.length !== 0;
  return (
    <div class="library-sections">
      {rights.mayBegin && <SectionBar desk={desk} />}
      {!isOpen && <p class="quiet">{say("library.guest")}</p>}
      {isOpen && <FinderBar desk={desk} />}
      {isFound && <FoundBy desk={desk} />}
      <div class="library-body">
        {isOpen && <Collections desk={desk} />}
        <div class="library-main">
          {name === "trees" && rights.mayChange.value && !isNarrowed && want.words === "" && (
            <UnsavedSection studio={studio} />
          )}
          {!isFound && <NothingFound desk={desk} />}
          <TreeGrid desk={desk} />
          <More pages={section.pages} />
          {name === "templates" && !isNarrowed && <SpeciesTemplates studio={studio} words={want.words} />}
        </div>
      </div>
      <SelectionBar desk={desk} />
      <DragGhost drag={desk.drag} />
    </div>
  );
}

/** Which part of the library is shown; files for it; and what begins to choose trees. */
function SectionBar({ desk }: { readonly desk: LibraryDesk }) {
  const { section, studio } = desk;
  const trees = section.pages.items.value?.length ?? 0;
  return (
    <div class="library-bar">
      <fieldset class="segments" aria-label={say("library.sections")}>
        {SECTION_NAMES.filter((one) => one !== "deleted" || studio.rights.mayDelete).map((one) => (
          <label key={one}>
            <input
              type="radio"
              name="section"
              checked={one === section.name}
              onChange={() => {
                studio.layout.section.value = one;
              }}
            />
            <span>{say(`library.section.${one}`)}</span>
          </label>
        ))}
      </fieldset>
      <div class="library-deeds">
        {trees > 0 && section.chosen.value === null && (
          <button
            type="button"
            class="small"
            onClick={() => {
              section.chosen.value = new Set();
            }}
          >
            {say("library.select")}
          </button>
        )}
        {section.name === "trees" && <OpenFile desk={desk} />}
      </div>
    </div>
  );
}
