import { useState } from "preact/hooks";
import type { UnsavedTree } from "../../library/unsaved-tree";
import type { Studio } from "../../studio";
import { dateText } from "../../words/date-text";
import { language, say } from "../../words/say";
import { DeleteIcon } from "../icons";
import { TreePicture } from "./tree-picture";

/** The trees of this device that were left and not saved; a tap goes on with one. */
export function UnsavedSection({ studio }: { studio: Studio }) {
  const here = studio.link.session.value;
  const trees = studio.unsaved.list.value.filter(({ session }) => session !== here);
  if (trees.length === 0) {
    return null;
  }
  return (
    <section class="unsaved" aria-label={say("sheets.unsaved")}>
      <h3>{say("sheets.unsaved")}</h3>
      <p class="quiet">{say("sheets.unsaved.advice")}</p>
      <ul class="library">
        {trees.map((tree) => (
          <UnsavedCard key={tree.session} studio={studio} tree={tree} />
        ))}
      </ul>
      <h3>{say("sheets.saved")}</h3>
    </section>
  );
}

function UnsavedCard({ studio, tree }: { studio: Studio; tree: UnsavedTree }) {
  const [asks, setAsks] = useState(false);
  const { session, metamers, left, thumbnail } = tree;
  const date = dateText(left);
  return (
    <li class="card">
      <button
        type="button"
        class="card-open"
        aria-label={say("sheets.unsaved.open", { date })}
        onClick={() => studio.trees.goOnWith(session)}
      >
        <TreePicture url={thumbnail} />
      </button>
      {asks ? (
        <div class="card-confirm">
          <span>{say("sheets.unsaved.forget.sure")}</span>
          <button type="button" class="small danger" onClick={() => studio.unsaved.forget(session)}>
            {say("sheets.unsaved.forget")}
          </button>
          <button type="button" class="small" onClick={() => setAsks(false)}>
            {say("sheets.library.keep")}
          </button>
        </div>
      ) : (
        <div class="card-foot">
          <span class="quiet card-facts">
            {say("notices.metamers", { count: metamers.toLocaleString(language.value) })}
            <br />
            {date}
          </span>
          <button
            type="button"
            class="tool"
            aria-label={say("sheets.unsaved.forget.which", { date })}
            title={say("sheets.unsaved.forget")}
            onClick={() => setAsks(true)}
          >
            <DeleteIcon />
          </button>
        </div>
      )}
    </li>
  );
}
