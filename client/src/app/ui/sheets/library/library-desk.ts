import type { Signal } from "@preact/signals";
import { Catalogue } from "../../../library/catalogue";
import * as api from "../../../library/library-api";
import { LibrarySection } from "../../../library/library-section";
import { said } from "../../../library/save-tree";
import { ANYTHING, isWanted, type Wanted } from "../../../library/wanted";
import type { SectionName } from "../../../page/layout";
import { kept } from "../../../page/settings";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { knownSpecies } from "../../panels/architecture/species-list";
import { TreeDrag } from "./tree-drag";

/** What somebody looks for, as long as the tab of the browser is open. */
const wanted = kept<Wanted>(sessionStorage, "finding", ANYTHING, isWanted);

/** What the parts of the open library work with. */
export interface LibraryDesk {
  readonly studio: Studio;
  readonly section: LibrarySection;
  readonly catalogue: Catalogue;
  readonly wanted: Signal<Wanted>;
  readonly drag: TreeDrag;
}

export function openDesk(studio: Studio, name: SectionName): LibraryDesk {
  const show = studio.toasts.show.bind(studio.toasts);
  const catalogue = new Catalogue({ api, show });
  const section = new LibrarySection({
    name,
    api,
    wanted: () => wanted.peek(),
    species: knownSpecies,
    said: () => said(studio),
    show,
  });
  const drag = new TreeDrag({
    dropped: (trees, id) => void section.move(trees, catalogue.folder(id) ?? null),
    missed: () => show(say("finding.dropped-beside")),
  });
  return { studio, section, catalogue, wanted, drag };
}
