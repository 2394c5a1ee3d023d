import { useState } from "preact/hooks";
import { saveWithPicture } from "../../library/save-tree";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { NameField, usualName } from "./name-field";

/** Asks where the tree on the page stays when a new one is begun: in the library, under Unsaved, or nowhere. */
export function LeaveSheet({ studio }: { studio: Studio }) {
  const [name, setName] = useState(() => studio.trees.name.peek() ?? usualName());
  const [leaving, setLeaving] = useState(false);
  const trimmed = name.trim();

  const leave = async (first: () => Promise<void>, keeps: boolean) => {
    if (leaving) {
      return;
    }
    setLeaving(true);
    try {
      await first();
      await studio.trees.leave(undefined, keeps);
    } catch (error) {
      studio.toasts.show(sentence(error));
    }
    setLeaving(false);
  };
  const save = async (event: Event) => {
    event.preventDefault();
    const session = studio.link.session.peek();
    if (session !== null && trimmed !== "") {
      await leave(() => saveWithPicture(studio, session, trimmed), true);
    }
  };

  return (
    <form class="stack" onSubmit={save}>
      <p>{say("sheets.leave.text")}</p>
      <NameField name={name} onInput={setName} />
      <div class="actions">
        <button type="button" class="small danger" disabled={leaving} onClick={() => leave(async () => {}, false)}>
          {say("sheets.leave.drop")}
        </button>
        <button type="button" class="small" disabled={leaving} onClick={() => leave(async () => {}, true)}>
          {say("sheets.leave.keep")}
        </button>
        <button type="submit" class="primary" disabled={trimmed === "" || leaving}>
          {say(leaving ? "sheets.save.saving" : "sheets.leave.save")}
        </button>
      </div>
    </form>
  );
}
