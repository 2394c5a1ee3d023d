import { useState } from "preact/hooks";
import type { SavedTree } from "../../../../wire/generated";
import { speciesName } from "../../../document/species/species-choice";
import { pathOf } from "../../../library/catalogue";
import { isNamed } from "../../../library/species-words";
import { turntableOf } from "../../../library/turntable";
import { dateText } from "../../../words/date-text";
import { language, say } from "../../../words/say";
import { useSpecies } from "../../panels/architecture/species-list";
import { TreePicture } from "../tree-picture";
import { CardForm } from "./card-form";
import { CardMenu, type Deed, only } from "./card-menu";
import { FoundText } from "./found-text";
import { StarIcon } from "./icons";
import type { LibraryDesk } from "./library-desk";
import { MoveForm } from "./move-form";
import { TagForm } from "./tag-form";
import { usePress } from "./use-press";
import { useHover, useTurntable } from "./use-turntable";

/** What of a tree is changed in a row of its card. */
type Edited = "name" | "note" | "tags" | "collection";

interface TreeCardProps {
  readonly desk: LibraryDesk;
  readonly tree: SavedTree;
}

/**
 * A tree of the library: a tap opens it, a finger held on it chooses it, dragged it is moved to a collection, a finger
 * that moves across it or a mouse that stays on it turns it, and the rest is in its menu.
 */
export function TreeCard({ desk, tree }: TreeCardProps) {
  const { studio, section } = desk;
  const [edited, setEdited] = useState<Edited | null>(null);
  const { name } = tree;
  const chosen = section.chosen.value;
  const begin = () => void studio.trees.leave({ tree, template: true });
  const open = () => void studio.trees.leave({ tree });
  const isTemplate = section.name === "templates";
  const isChosen = chosen?.has(tree.id) ?? false;
  const { words } = desk.wanted.value;
  const { rights } = studio;
  const { mayBegin, mayDelete } = rights;
  const mayChange = rights.mayChange.value;
  const species = useSpecies(studio)?.find(({ slug }) => slug === tree.species);
  const turntable = useTurntable(turntableOf(tree.id, tree.version));
  const hover = useHover(turntable);
  const press = usePress({
    turned: (pushed) => (pushed === null ? turntable.end() : turntable.push(pushed)),
    tapped: () => (chosen === null ? (isTemplate ? begin() : open()) : section.toggle(tree.id)),
    held: () => isChosen || !mayBegin || section.toggle(tree.id),
    dragged:
      section.name === "deleted" || !mayBegin
        ? undefined
        : (at) => desk.drag.begin(section.chosen.peek()?.has(tree.id) ? section.chosenTrees : [tree], at),
  });
  const deeds: readonly Deed[] = [
    { label: say("library.open"), act: open },
    ...only(mayBegin, { label: say("library.begin"), act: begin }),
    ...only(
      mayChange,
      { label: say("library.rename"), act: () => setEdited("name") },
      { label: say("library.note"), act: () => setEdited("note") },
      { label: say("finding.edit-tags"), act: () => setEdited("tags") },
    ),
    ...only(mayBegin, { label: say("finding.move"), act: () => setEdited("collection") }),
    {
      label: say("library.versions", { count: tree.version }),
      act: () => {
        studio.layout.subject.value = tree;
        studio.layout.sheet.value = "versions";
      },
    },
    ...only(mayBegin, { label: say("library.duplicate"), act: () => void section.duplicate([tree]) }),
    ...only(mayBegin, {
      label: say(isTemplate ? "library.unmark" : "library.mark"),
      act: () => void section.mark([tree], !isTemplate),
    }),
    {
      label: say("library.download"),
      act: () => {
        studio.layout.taken.value = tree;
        studio.layout.sheet.value = "download";
      },
    },
    ...only(rights.mayOrder, {
      label: say("library.variations"),
      act: () => {
        studio.layout.pattern.value = { template: tree.id, name, picture: tree.thumbnail };
        studio.layout.sheet.value = "variations";
      },
    }),
    ...only(
      rights.mayShare,
      {
        label: say("gifts.open"),
        act: () => {
          const folder = desk.catalogue.folder(tree.collection);
          const { id } = tree;
          studio.layout.given.value = { kind: "tree", id, name, from: "library", within: folder && pathOf(folder) };
          studio.layout.sheet.value = "gifts";
        },
      },
      {
        label: say("library.share"),
        act: () => {
          studio.layout.shared.value = tree;
          studio.layout.sheet.value = "share";
        },
      },
    ),
    ...only(mayDelete, { label: say("library.delete"), act: () => void section.remove([tree]) }),
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
        onPointerMove={(event) => {
          press.onPointerMove(event);
          hover.moved(event);
        }}
        onPointerLeave={hover.left}
      >
        <TreePicture url={tree.thumbnail} />
        {turntable.style && <i class="card-turn" aria-hidden="true" style={turntable.style} />}
        {chosen !== null && <i class="card-tick" aria-hidden="true" />}
      </button>
      {chosen === null && edited === null && (
        <button
          type="button"
          class="tool card-star"
          aria-label={say("finding.star", { name })}
          aria-pressed={tree.favourite}
          onClick={() => void section.star(tree)}
        >
          <StarIcon />
        </button>
      )}
      {edited !== null ? (
        <CardEditor desk={desk} tree={tree} edited={edited} onEnd={() => setEdited(null)} />
      ) : (
        <div class="card-foot">
          <strong class="card-name">
            <FoundText text={name} words={words} />
          </strong>
          <span class="quiet card-facts">
            {say("notices.metamers", { count: tree.metamers.toLocaleString(language.value) })}
            <br />
            {tree.author && `${tree.author}, `}
            <span class="card-date">{dateText(tree.saved_at)}</span>
          </span>
          {chosen === null && <CardMenu label={say("library.more-of", { name })} deeds={deeds} />}
          {tree.people > 0 && <span class="card-people">{say("library.people", { count: tree.people })}</span>}
          {tree.tags.length > 0 && (
            <p class="quiet card-tags">
              {tree.tags.map((tag) => (
                <span key={tag}>
                  <FoundText text={tag} words={words} />
                </span>
              ))}
            </p>
          )}
          {tree.note !== "" && (
            <p class="quiet card-note">
              <FoundText text={tree.note} words={words} />
            </p>
          )}
          {species !== undefined && isNamed(words, species) && (
            <p class="quiet card-note">
              {say("finding.species")}: <FoundText text={speciesName(species)} words={words} />
            </p>
          )}
        </div>
      )}
    </li>
  );
}

interface CardEditorProps extends TreeCardProps {
  readonly edited: Edited;
  readonly onEnd: () => void;
}

/** The row in which something of a tree is changed. */
function CardEditor({ desk: { section, catalogue }, tree, edited, onEnd }: CardEditorProps) {
  const { name } = tree;
  switch (edited) {
    case "name":
    case "note":
      return (
        <CardForm
          kind={edited}
          label={say(edited === "name" ? "library.new-name" : "library.note-of", { name })}
          value={tree[edited]}
          onSave={(value) => void section.change(tree, { [edited]: value })}
          onEnd={onEnd}
        />
      );
    case "tags":
      return (
        <TagForm
          label={say("finding.tags-of", { name })}
          tags={tree.tags}
          known={catalogue.tags.value}
          onSave={(tags) => void section.change(tree, { tags }).then(() => catalogue.refresh())}
          onEnd={onEnd}
        />
      );
    case "collection":
      return (
        <MoveForm
          label={say("finding.move.which", { name })}
          folders={catalogue.folders.value ?? []}
          value={tree.collection ?? ""}
          onMove={(to) => void section.move([tree], catalogue.folder(to) ?? null)}
          onEnd={onEnd}
        />
      );
  }
}
