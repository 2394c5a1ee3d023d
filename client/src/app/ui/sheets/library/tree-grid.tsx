import { useRef } from "preact/hooks";
import { DeletedCard } from "./deleted-card";
import { neighbour } from "./grid-keys";
import type { LibraryDesk } from "./library-desk";
import { TreeCard } from "./tree-card";

/** The trees in pictures; arrows lead from one to the next, Delete deletes. */
export function TreeGrid({ desk }: { readonly desk: LibraryDesk }) {
  const { section } = desk;
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
          <TreeCard key={tree.id} desk={desk} tree={tree} />
        ),
      )}
    </ul>
  );
}
