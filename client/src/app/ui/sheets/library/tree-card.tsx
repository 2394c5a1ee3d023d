import { useState } from "preact/hooks";
import type { SavedTree } from "../../../../wire/generated";
import type { LibrarySection } from "../../../library/library-section";
import type { Studio } from "../../../studio";
import { dateText } from "../../../words/date-text";
import { language, say } from "../../../words/say";
import { TreePicture } from "../tree-picture";
import { CardForm } from "./card-form";
import { CardMenu, type Deed } from "./card-menu";
import { useHold } from "./use-hold";

interface TreeCardProps {
  readonly studio: Studio;
  readonly section: LibrarySection;
  readonly tree: SavedTree;
}

/** A tree of the library: a tap opens it, a finger held on it chooses it, and the rest is in its menu. */
export function TreeCard({ studio, section, tree }: TreeCardProps) {
  const [edited, setEdited] = useState<"name" | "note" | null>(null);
  const { name } = tree;
  const chosen = section.chosen.value;
  const begin = () => void studio.trees.leave({ tree, template: true });
  const open = () => void studio.trees.leave({ tree });
  const isTemplate = section.name === "templates";
  const isChosen = chosen?.has(tree.id) ?? false;
  const press = useHold(
    () => section.toggle(tree.id),
    () => (chosen === null ? (isTemplate ? begin() : open()) : section.toggle(tree.id)),
  );
  const deeds: readonly Deed[] = [
    { label: say("library.open"), act: open },
    { label: say("library.begin"), act: begin },
    { label: say("library.rename"), act: () => setEdited("name") },
    { label: say("library.note"), act: () => setEdited("note") },
    {
      label: say("library.versions", { count: tree.version }),
      act: () => {
        studio.layout.subject.value = tree;
        studio.layout.sheet.value = "versions";
      },
    },
    { label: say("library.duplicate"), act: () => void section.duplicate([tree]) },
    {
      label: say(isTemplate ? "library.unmark" : "library.mark"),
      act: () => void section.mark([tree], !isTemplate),
    },
    { label: say("library.delete"), act: () => void section.remove([tree]) },
  ];
  const label = chosen === null ? (isTemplate ? "library.begin-which" : "sheets.library.open") : "library.choose";
  return (
    <li class="card" data-tree={tree.id} data-chosen={isChosen} data-edited={edited !== null}>
      <button
        type="button"
        class="card-open"
        aria-label={say(label, { name })}
        aria-pressed={chosen === null ? undefined : isChosen}
        {...press}
      >
        <TreePicture url={tree.thumbnail} />
        {chosen !== null && <i class="card-tick" aria-hidden="true" />}
      </button>
      {edited !== null ? (
        <CardForm
          kind={edited}
          label={say(edited === "name" ? "library.new-name" : "library.note-of", { name })}
          value={tree[edited]}
          onSave={(value) => void section.change(tree, { [edited]: value })}
          onEnd={() => setEdited(null)}
        />
      ) : (
        <div class="card-foot">
          <strong class="card-name">{name}</strong>
          <span class="quiet card-facts">
            {say("notices.metamers", { count: tree.metamers.toLocaleString(language.value) })}
            <br />
            {[tree.author, dateText(tree.saved_at)].filter(Boolean).join(", ")}
          </span>
          {chosen === null && <CardMenu label={say("library.more-of", { name })} deeds={deeds} />}
          {tree.people > 0 && <span class="card-people">{say("library.people", { count: tree.people })}</span>}
          {tree.note !== "" && <p class="quiet card-note">{tree.note}</p>}
        </div>
      )}
    </li>
  );
}
