import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS, type SavedTree } from "../../../wire/generated";
import { deleteTree, listTrees, renameTree } from "../../library/library-api";
import { LibraryPages } from "../../library/library-pages";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { dateText } from "../../words/date-text";
import { language, say } from "../../words/say";
import { DeleteIcon, RenameIcon } from "../icons";
import { TreePicture } from "./tree-picture";
import { UnsavedSection } from "./unsaved-section";

/** The saved trees; a tap opens one as a new session. */
export function LibrarySheet({ studio }: { studio: Studio }) {
  const pages = useMemo(() => new LibraryPages(listTrees), []);
  const trees = pages.trees.value;
  const failure = pages.failure.value;
  useEffect(() => void pages.next(), [pages]);
  return (
    <>
      <UnsavedSection studio={studio} />
      {trees === null && failure === null && <p class="quiet empty">{say("notices.looking")}</p>}
      {trees?.length === 0 && <p class="quiet empty">{say("sheets.library.empty")}</p>}
      <ul class="library">
        {trees?.map((tree) => (
          <TreeCard key={tree.id} studio={studio} tree={tree} onChange={(changed) => pages.replace(tree.id, changed)} />
        ))}
      </ul>
      {failure !== null && (
        <p class="quiet empty" role="status">
          {sentence(failure)}
        </p>
      )}
      {(failure !== null || (trees !== null && pages.more.value)) && <More key={trees?.length} pages={pages} />}
    </>
  );
}

/** The end of the list: what lies behind it comes when it is scrolled to, or asked for. */
function More({ pages }: { pages: LibraryPages }) {
  const end = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    // After a failure only who asks is answered, or a server that is away would be asked all the time.
    if (!end.current || pages.failure.peek() !== null) {
      return undefined;
    }
    const watcher = new IntersectionObserver(
      ([seen]) => {
        if (seen?.isIntersecting) {
          void pages.next();
        }
      },
      { rootMargin: "300px" },
    );
    watcher.observe(end.current);
    return () => watcher.disconnect();
  }, [pages]);
  return (
    <button type="button" class="small library-more" ref={end} onClick={() => void pages.next()}>
      {say(pages.failure.value === null ? "sheets.library.more" : "sheets.library.again")}
    </button>
  );
}

interface TreeCardProps {
  readonly studio: Studio;
  readonly tree: SavedTree;
  /** The tree was renamed, or is gone. */
  readonly onChange: (tree: SavedTree | null) => void;
}

function TreeCard({ studio, tree, onChange }: TreeCardProps) {
  const [mode, setMode] = useState<"show" | "rename" | "delete">("show");
  const attempt = (work: Promise<void>) => {
    setMode("show");
    work.catch((error: unknown) => studio.toasts.show(sentence(error)));
  };
  const rename = (event: SubmitEvent) => {
    event.preventDefault();
    const name = new FormData(event.currentTarget as HTMLFormElement).get("name")?.toString().trim() ?? "";
    if (name !== "" && name !== tree.name) {
      attempt(renameTree(tree.id, name).then(onChange));
    } else {
      setMode("show");
    }
  };

  return (
    <li class="card">
      <button
        type="button"
        class="card-open"
        aria-label={say("sheets.library.open", { name: tree.name })}
        onClick={() => studio.trees.leave(tree)}
      >
        <TreePicture url={tree.thumbnail} />
      </button>
      {mode === "rename" && (
        <form class="card-rename" onSubmit={rename}>
          <input
            name="name"
            aria-label={say("sheets.library.new-name")}
            maxLength={MAX_NAME_CHARACTERS}
            autocomplete="off"
            defaultValue={tree.name}
            ref={(input) => input?.focus()}
            onKeyDown={(event) => {
              if (event.key === "Escape") {
                event.preventDefault();
                setMode("show");
              }
            }}
          />
          <button type="submit" class="small">
            {say("sheets.library.rename")}
          </button>
        </form>
      )}
      {mode === "delete" && (
        <div class="card-confirm">
          <span>{say("sheets.library.delete.sure")}</span>
          <button
            type="button"
            class="small danger"
            onClick={() => attempt(deleteTree(tree.id).then(() => onChange(null)))}
          >
            {say("sheets.library.delete")}
          </button>
          <button type="button" class="small" onClick={() => setMode("show")}>
            {say("sheets.library.keep")}
          </button>
        </div>
      )}
      {mode === "show" && (
        <div class="card-foot">
          <strong class="card-name">{tree.name}</strong>
          <span class="quiet card-facts">
            {say("notices.metamers", { count: tree.metamers.toLocaleString(language.value) })}
            <br />
            {dateText(tree.saved_at)}
          </span>
          <button
            type="button"
            class="tool"
            aria-label={say("sheets.library.rename.which", { name: tree.name })}
            title={say("sheets.library.rename")}
            onClick={() => setMode("rename")}
          >
            <RenameIcon />
          </button>
          <button
            type="button"
            class="tool"
            aria-label={say("sheets.library.delete.which", { name: tree.name })}
            title={say("sheets.library.delete")}
            onClick={() => setMode("delete")}
          >
            <DeleteIcon />
          </button>
        </div>
      )}
    </li>
  );
}
