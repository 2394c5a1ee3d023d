import type { Belonging } from "../../library/belonging";
import type { Studio } from "../../studio";
import { momentText } from "../../words/date-text";
import { say } from "../../words/say";
import { TreePicture } from "./tree-picture";

interface OvertakenProps {
  readonly studio: Studio;
  readonly belonging: Belonging;
}

/** Tells that the library has a newer version than the one that the tree on the page comes from. */
export function Overtaken({ studio, belonging: { tree, version } }: OvertakenProps) {
  return (
    <section class="overtaken" role="alert">
      <TreePicture url={tree.thumbnail} />
      <div class="stack">
        <p>
          {say(tree.author === undefined ? "sheets.save.overtaken" : "sheets.save.overtaken.by", {
            number: tree.version,
            time: momentText(tree.saved_at),
            author: tree.author ?? "",
            version,
          })}
        </p>
        <button
          type="button"
          class="small"
          onClick={() => {
            studio.layout.subject.value = tree;
            studio.layout.sheet.value = "versions";
          }}
        >
          {say("sheets.save.see")}
        </button>
      </div>
    </section>
  );
}
