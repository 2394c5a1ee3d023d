import { useState } from "preact/hooks";
import type { SavedTree } from "../../../../wire/generated";
import type { LibrarySection } from "../../../library/library-section";
import { daysLeft } from "../../../library/time-between";
import { say } from "../../../words/say";
import { TreePicture } from "../tree-picture";

/** A tree that was deleted and can be taken back, or deleted for good. */
export function DeletedCard({ section, tree }: { readonly section: LibrarySection; readonly tree: SavedTree }) {
  const days = daysLeft(tree.deleted_at ?? tree.saved_at);
  const [asks, setAsks] = useState(false);
  return (
    <li class="card" data-tree={tree.id}>
      <div class="card-open" data-faded>
        <TreePicture url={tree.thumbnail} />
      </div>
      <div class="card-foot">
        <strong class="card-name">{tree.name}</strong>
        <span class="quiet card-facts card-days">
          {days === 0
            ? say("library.days-left.last")
            : days === 1
              ? say("library.days-left.one")
              : say("library.days-left", { count: days })}
        </span>
        {asks ? (
          <div class="card-confirm">
            <span>{say("library.for-good.sure", { name: tree.name })}</span>
            <button type="button" class="small danger" onClick={() => void section.removeForGood(tree)}>
              {say("library.for-good")}
            </button>
            <button type="button" class="small" onClick={() => setAsks(false)}>
              {say("finding.keep")}
            </button>
          </div>
        ) : (
          <>
            <button
              type="button"
              class="small card-back"
              aria-label={say("library.take-back.which", { name: tree.name })}
              onClick={() => void section.takeBack([tree])}
            >
              {say("library.take-back")}
            </button>
            <button
              type="button"
              class="small card-for-good"
              aria-label={say("library.for-good.which", { name: tree.name })}
              onClick={() => setAsks(true)}
            >
              {say("library.for-good")}
            </button>
          </>
        )}
      </div>
    </li>
  );
}
