import { useState } from "preact/hooks";
import { saveWithPicture } from "../../library/save-tree";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { NameField, usualName } from "./name-field";

/** Asks for a name and saves the tree with its picture. */
export function SaveSheet({ studio }: { studio: Studio }) {
  const [name, setName] = useState(() => studio.trees.name.peek() ?? usualName());
  const [saving, setSaving] = useState(false);
  const trimmed = name.trim();

  const save = async (event: Event) => {
    event.preventDefault();
    const session = studio.link.session.peek();
    if (session === null || trimmed === "" || saving) {
      return;
    }
    setSaving(true);
    try {
      await saveWithPicture(studio, session, trimmed);
      studio.toasts.show(say("sheets.save.done", { name: trimmed }));
      // The user may have closed the sheet meanwhile and opened another one.
      if (studio.layout.sheet.peek() === "save") {
        studio.layout.sheet.value = null;
      }
    } catch (error) {
      studio.toasts.show(sentence(error));
      setSaving(false);
    }
  };

  return (
    <form class="stack" onSubmit={save}>
      <NameField name={name} onInput={setName} />
      <p class="quiet">{say("sheets.save.advice")}</p>
      <div class="actions">
        <button type="submit" class="primary" disabled={trimmed === "" || saving}>
          {say(saving ? "sheets.save.saving" : "sheets.save.act")}
        </button>
      </div>
    </form>
  );
}
