import { useState } from "preact/hooks";
import { saveTree } from "../../library/library-api";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { language, say } from "../../words/say";

/** A picture larger than this would be refused; the limit is 192 KiB. */
const MAX_PICTURE = 190 * 1024;

/** Asks for a name and saves the tree with its picture. */
export function SaveSheet({ studio }: { studio: Studio }) {
  const [name, setName] = useState(() =>
    say("sheets.save.default", { date: new Date().toLocaleDateString(language.value, { dateStyle: "medium" }) }),
  );
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
      const thumbnail = await picture(studio);
      await saveTree({ session, name: trimmed, ...(thumbnail === undefined ? {} : { thumbnail }) });
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
      <label class="field">
        <span>{say("sheets.save.name")}</span>
        <input
          type="text"
          value={name}
          maxLength={80}
          autocomplete="off"
          enterkeyhint="done"
          onFocus={(event) => event.currentTarget.select()}
          onInput={(event) => setName(event.currentTarget.value)}
        />
      </label>
      <p class="quiet">{say("sheets.save.advice")}</p>
      <div class="actions">
        <button type="submit" class="primary" disabled={trimmed === "" || saving}>
          {say(saving ? "sheets.save.saving" : "sheets.save.act")}
        </button>
      </div>
    </form>
  );
}

/** The largest picture that fits; a tree can be saved without one. */
async function picture(studio: Studio): Promise<string | undefined> {
  for (const size of [512, 384, 256]) {
    const url = await studio.stage.thumbnail(size).catch(() => undefined);
    if (url === undefined || url.length <= MAX_PICTURE) {
      return url;
    }
  }
  return undefined;
}
