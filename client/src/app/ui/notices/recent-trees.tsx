import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { listTrees } from "../../library/library-api";
import { unsavedSessions } from "../../library/unsaved-sessions";
import type { UnsavedTree } from "../../library/unsaved-tree";
import type { Studio } from "../../studio";
import { dateText } from "../../words/date-text";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";
import { FromTemplate } from "../sheets/library/from-template";
import { TreePicture } from "../sheets/tree-picture";

/** So many are shown. */
const MOST = 4;

interface Recent {
  readonly key: string;
  readonly name: string;
  /** When it was left or saved, as ISO 8601 has it. */
  readonly at: string;
  readonly thumbnail?: string | undefined;
  readonly open: () => Promise<unknown>;
}

/** The session in which somebody has hidden them: they stay so where the card goes and comes again beside a stroke. */
const hiddenIn = signal<string | null>(null);

/** On a page on which nothing has grown yet: the trees that were worked on last, to go on with. */
export function RecentTrees({ studio }: { studio: Studio }) {
  const [saved, setSaved] = useState<readonly Recent[]>([]);
  const remembered = studio.unsaved.list.value;
  const [unsaved, setUnsaved] = useState<readonly UnsavedTree[]>(remembered);
  useEffect(() => {
    if (studio.rights.mayChange.peek()) {
      // As above: what this device remembers stands until the server answers.
      void unsavedSessions(studio.rights.me.peek()?.way, remembered)
        .then(setUnsaved)
        .catch(() => setUnsaved(remembered));
    }
  }, [studio, remembered]);
  useEffect(() => {
    const show = async () => {
      const { items } = await listTrees(MOST);
      setSaved(
        items.map((tree) => {
          const { id, name, saved_at: at, thumbnail } = tree;
          return { key: id, name, at, thumbnail, open: () => studio.trees.leave({ tree }) };
        }),
      );
    };
    // A library that does not answer now is no reason to disturb who wants to draw; its sheet says why.
    void show().catch(() => {});
  }, [studio]);
  const here = studio.link.session.value;
  const left = unsaved
    .filter(({ session }) => session !== here)
    .map(({ session, left: at, thumbnail }) => {
      return { key: session, name: say("sheets.unsaved"), at, thumbnail, open: () => studio.trees.goOnWith(session) };
    });
  const recent = [...left, ...saved].sort((a, b) => Date.parse(b.at) - Date.parse(a.at)).slice(0, MOST);
  if (hiddenIn.value === here || recent.length === 0) {
    return null;
  }
  return (
    <section class="panel recent" aria-label={say("sheets.recent")}>
      <header>
        <h2>{say("sheets.recent")}</h2>
        <button
          type="button"
          class="tool"
          aria-label={say("sheets.recent.hide")}
          onClick={() => {
            hiddenIn.value = here;
          }}
        >
          <CloseIcon />
        </button>
      </header>
      <ul>
        {recent.map(({ key, name, at, thumbnail, open }) => (
          <li key={key}>
            <button type="button" class="recent-tree" onClick={() => void open()}>
              <TreePicture url={thumbnail} />
              <span class="recent-name">{name}</span>
              <span class="quiet">{dateText(at)}</span>
            </button>
          </li>
        ))}
      </ul>
      <FromTemplate studio={studio} />
    </section>
  );
}
