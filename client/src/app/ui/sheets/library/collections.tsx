import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { type Folder, placesFor } from "../../../library/catalogue";
import { type Key, say } from "../../../words/say";
import { CardForm } from "./card-form";
import { CardMenu, only } from "./card-menu";
import { AddIcon, FolderIcon } from "./icons";
import type { LibraryDesk } from "./library-desk";
import { MoveForm, placesIn } from "./move-form";
import { Pick } from "./pick";

/** What is done with a collection; a new one may lie in it. */
type Deed = "rename" | "new" | "move" | "delete";

/** What stands for all trees among the collections to pick from. */
const ALL = "all";

/**
 * The collections, beside the trees where there is room, else above them; trees are dragged onto them. On a phone they
 * are picked from a list, and stand in a row while trees are chosen or dragged.
 */
export function Collections({ desk }: { readonly desk: LibraryDesk }) {
  const { catalogue, wanted, studio } = desk;
  const [making, setMaking] = useState(false);
  /** The collection that was made last. */
  const [made, setMade] = useState<string | null>(null);
  const folders = catalogue.folders.value;
  const here = wanted.value.collection;
  useEffect(() => {
    // Somebody else may have deleted the one that was looked into last.
    if (folders !== null && here && !folders.some(({ id }) => id === here)) {
      wanted.value = { ...wanted.value, collection: null };
    }
  }, [folders, here, wanted]);
  const add = async (name: string, parent?: string) => {
    const collection = await catalogue.add(name, parent);
    if (collection) {
      setMade(collection.id);
      studio.toasts.show(say("finding.new.done", { name }));
    }
  };
  return (
    <nav aria-label={say("finding.collections")}>
      <ul class="collections" data-dragged={desk.drag.held.value !== null} data-row={isRow(desk)}>
        {folders !== null && folders.length > 0 && (
          <li class="collection-pick">
            <Pick
              label={say("finding.collections")}
              value={here ?? ALL}
              options={[[ALL, say("finding.all")], ...placesIn(folders)]}
              onPick={(to) => {
                wanted.value = { ...wanted.value, collection: to === ALL ? null : to };
              }}
            />
          </li>
        )}
        <Place desk={desk} to={null}>
          {say("finding.all")}
        </Place>
        {folders !== null && folders.length > 0 && (
          <Place desk={desk} to="">
            {say("finding.nowhere")}
          </Place>
        )}
        {folders?.map((folder) => (
          <Entry key={folder.id} desk={desk} folder={folder} isNew={folder.id === made} add={add} />
        ))}
        {studio.rights.mayChange.value && (
          <li class="collection-row">
            {making ? (
              <CardForm
                kind="name"
                label={say("finding.new.name")}
                value=""
                onSave={(name) => void add(name)}
                onEnd={() => setMaking(false)}
              />
            ) : (
              <button
                type="button"
                class="collection collection-new"
                aria-label={say("finding.new")}
                onClick={() => setMaking(true)}
              >
                <AddIcon />
                <span>{say("finding.new")}</span>
              </button>
            )}
          </li>
        )}
      </ul>
    </nav>
  );
}

/** Whether they stand in a row on a phone as well: trees are dropped there. */
function isRow({ drag, section }: LibraryDesk): boolean {
  return drag.held.value !== null || section.chosen.value !== null;
}

interface EntryProps {
  readonly desk: LibraryDesk;
  readonly folder: Folder;
  readonly isNew: boolean;
  readonly add: (name: string, parent: string) => Promise<void>;
}

function Entry({ desk, folder, isNew, add }: EntryProps) {
  const { catalogue, wanted, studio } = desk;
  const { id, name, parent = "", depth, above } = folder;
  const [deed, setDeed] = useState<Deed | null>(null);
  const end = () => setDeed(null);
  const remove = async () => {
    if (await catalogue.remove(id)) {
      if (wanted.peek().collection === id) {
        wanted.value = { ...wanted.peek(), collection: parent === "" ? null : parent };
      }
      studio.toasts.show(say("finding.gone", { name }));
    }
  };
  const begin = (label: Key, one: Deed) => ({ label: say(label), act: () => setDeed(one) });
  const share = () => {
    const within = above.length === 0 ? undefined : above.join(" › ");
    studio.layout.given.value = { kind: "collection", id, name, from: "library", within };
    studio.layout.sheet.value = "gifts";
  };
  const deeds = [
    begin("library.rename", "rename"),
    begin("finding.new-in", "new"),
    begin("finding.move", "move"),
    ...only(studio.rights.mayShare, { label: say("gifts.open"), act: share }),
    {
      label: say("finding.delete"),
      act: () => {
        // The question tells how many trees lie there now.
        void catalogue.refresh();
        setDeed("delete");
      },
    },
  ];
  const menu = studio.rights.mayChange.value && wanted.value.collection === id && deed === null && (
    <CardMenu label={say("finding.more-of", { name })} deeds={deeds} />
  );
  return (
    <Place desk={desk} to={id} depth={depth} isNew={isNew} beside={menu} below={doing()}>
      {above.length > 0 && <span class="collection-above">{above.join(" › ")} › </span>}
      {name}
    </Place>
  );

  function doing() {
    switch (deed) {
      case null:
        return null;
      case "rename":
      case "new":
        return (
          <CardForm
            kind="name"
            label={deed === "new" ? say("finding.new.name") : say("finding.new-name", { name })}
            value={deed === "new" ? "" : name}
            onSave={(typed) => void (deed === "new" ? add(typed, id) : catalogue.rename(id, typed))}
            onEnd={end}
          />
        );
      case "move":
        return (
          <MoveForm
            label={say("finding.move.which", { name })}
            folders={placesFor(catalogue.folders.value ?? [], id)}
            value={parent}
            onMove={(to) => void catalogue.move(id, to)}
            onEnd={end}
          />
        );
      case "delete":
        return (
          <div class="card-confirm">
            <span>{sureText(folder)}</span>
            <button type="button" class="small danger" onClick={() => void remove()}>
              {say("finding.delete")}
            </button>
            <button type="button" class="small" onClick={end}>
              {say("finding.keep")}
            </button>
          </div>
        );
    }
  }
}

/** Asks whether a collection is to be deleted, and says where its trees will lie. */
function sureText({ name, trees, above }: Folder): string {
  const parent = above.at(-1);
  if (trees === 0) {
    return say("finding.delete.sure.empty", { name });
  }
  return parent === undefined
    ? say("finding.delete.sure", { name, count: trees })
    : say("finding.delete.sure.inside", { name, count: trees, parent });
}

interface PlaceProps {
  readonly desk: LibraryDesk;
  /** The collection; empty for none, null for all trees. */
  readonly to: string | null;
  readonly depth?: number;
  readonly isNew?: boolean;
  readonly children: ComponentChildren;
  readonly beside?: ComponentChildren;
  readonly below?: ComponentChildren;
}

/** Where trees lie: a press lists them, trees are dropped on it. What is new, looked into or asked about comes into sight. */
function Place({ desk, to, depth = 0, isNew = false, children, beside, below }: PlaceProps) {
  const { wanted, drag } = desk;
  const row = useRef<HTMLLIElement>(null);
  const isShown = isRow(desk);
  const isHere = wanted.value.collection === to;
  const isAsking = Boolean(below);
  useEffect(() => {
    if (isHere || isAsking || isNew) {
      row.current?.scrollIntoView({ block: "nearest", inline: "nearest" });
    }
  }, [isHere, isAsking, isNew, isShown]);
  return (
    <li class="collection-row" ref={row} style={{ "--depth": depth }} data-here={isHere}>
      <button
        type="button"
        class="collection"
        aria-current={isHere ? "true" : undefined}
        data-drop={to ?? undefined}
        data-over={to !== null && drag.held.value?.over === to}
        onClick={() => {
          wanted.value = { ...wanted.value, collection: to };
        }}
      >
        <FolderIcon />
        <span class="collection-name">{children}</span>
      </button>
      {beside}
      {below}
    </li>
  );
}
