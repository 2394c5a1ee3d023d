import { useEffect, useState } from "preact/hooks";
import { forgetSession, type LeftTree, unsavedSessions } from "../../library/unsaved-sessions";
import type { Studio } from "../../studio";
import { dateText } from "../../words/date-text";
import { language, say } from "../../words/say";
import { DeleteIcon } from "../icons";
import { TreePicture } from "./tree-picture";

/** The trees that were left and not saved, on any device; a tap goes on with one. */
export function UnsavedSection({ studio }: { studio: Studio }) {
  const [left, setLeft] = useState<readonly LeftTree[]>([]);
  const here = studio.link.session.value;
  const remembered = studio.unsaved.list.value;
  useEffect(() => {
    let isShown = true;
    const show = async () => {
      const way = studio.rights.me.peek()?.way;
      // A server that does not answer says so in the list below; this device remembers what was left on it.
      const listed = await unsavedSessions(way, remembered).catch(() =>
        remembered.map((tree) => ({ ...tree, people: 0 })),
      );
      if (isShown) {
        setLeft(listed);
      }
    };
    void show();
    return () => {
      isShown = false;
    };
  }, [studio, here, remembered]);
  const forget = async (session: string) => {
    // Where it is on no list any more, or the server does not answer, this device forgets it all the same.
    await forgetSession(session).catch(() => {});
    setLeft((trees) => trees.filter((tree) => tree.session !== session));
    studio.unsaved.forget(session);
  };
  const trees = left.filter(({ session }) => session !== here);
  if (trees.length === 0) {
    return null;
  }
  return (
    <section class="unsaved" aria-label={say("sheets.unsaved")}>
      <h3>{say("sheets.unsaved")}</h3>
      <p class="quiet">{say("sheets.unsaved.advice")}</p>
      <ul class="library">
        {trees.map((tree) => (
          <UnsavedCard key={tree.session} studio={studio} tree={tree} forget={() => void forget(tree.session)} />
        ))}
      </ul>
      <h3>{say("sheets.saved")}</h3>
    </section>
  );
}

function UnsavedCard({ studio, tree, forget }: { studio: Studio; tree: LeftTree; forget: () => void }) {
  const [asks, setAsks] = useState(false);
  const { session, metamers, left, thumbnail, of, people } = tree;
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
          <button type="button" class="small danger" onClick={forget}>
            {say("sheets.unsaved.forget")}
          </button>
          <button type="button" class="small" onClick={() => setAsks(false)}>
            {say("sheets.library.keep")}
          </button>
        </div>
      ) : (
        <div class="card-foot">
          <span class="quiet card-facts">
            {of !== undefined && (
              <>
                {say("sheets.unsaved.of", { name: of })}
                <br />
              </>
            )}
            {say("notices.metamers", { count: metamers.toLocaleString(language.value) })}
            <br />
            {people > 0 ? say("sheets.unsaved.in-work") : date}
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
