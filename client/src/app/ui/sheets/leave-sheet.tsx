import { useState } from "preact/hooks";
import { saveAsNew, saveAsNext } from "../../library/save-tree";
import { forgetSession } from "../../library/unsaved-sessions";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { FromTemplate } from "./library/from-template";
import { NameField, usualName } from "./name-field";
import { Looking, useBelonging } from "./save-sheet";

/** Asks where the tree on the page stays when a new one is begun: in the library, under Unsaved, or nowhere. */
export function LeaveSheet({ studio }: { studio: Studio }) {
  const belonging = useBelonging(studio);
  const { of } = belonging;
  const [name, setName] = useState(() => studio.trees.name.peek() ?? usualName(studio));
  const [leaving, setLeaving] = useState(false);
  const trimmed = name.trim();

  /** Leaves once the tree is where it should be; false if it is not. */
  const leave = async (first: () => Promise<boolean>, keeps: boolean) => {
    if (leaving) {
      return;
    }
    setLeaving(true);
    try {
      const session = studio.link.session.peek();
      if ((await first()) && (await studio.trees.leave(undefined, keeps)) && !keeps && session !== null) {
        // Where the server does not take it off the list, it is found under Unsaved once more.
        await forgetSession(session).catch(() => {});
      }
    } catch (error) {
      studio.toasts.show(sentence(error));
    }
    setLeaving(false);
  };
  const save = async (event: Event) => {
    event.preventDefault();
    const session = studio.link.session.peek();
    if (session === null || of === undefined || (of === null && trimmed === "")) {
      return;
    }
    await leave(async () => {
      if (of === null) {
        await saveAsNew(studio, session, trimmed);
        return true;
      }
      const saving = await saveAsNext(studio, session, of);
      if ("overtaken" in saving) {
        // There the user sees what was saved meanwhile.
        studio.layout.sheet.value = "save";
        return false;
      }
      return true;
    }, true);
  };
  const nothing = async () => true;

  return (
    <form class="stack" onSubmit={save}>
      <p>{say("sheets.leave.text")}</p>
      {of === undefined && <Looking belonging={belonging} />}
      {of === null && <NameField name={name} onInput={setName} />}
      {of && <p class="standing">{say("sheets.leave.next", { name: of.tree.name, number: of.tree.version + 1 })}</p>}
      <div class="answers">
        <button type="submit" class="primary" disabled={leaving || of === undefined || (of === null && trimmed === "")}>
          {say(leaving ? "sheets.save.saving" : "sheets.leave.save")}
        </button>
        <button type="button" class="small" disabled={leaving} onClick={() => leave(nothing, true)}>
          {say("sheets.leave.keep")}
        </button>
        <button type="button" class="small danger" disabled={leaving} onClick={() => leave(nothing, false)}>
          {say("sheets.leave.drop")}
        </button>
      </div>
      <FromTemplate studio={studio} />
    </form>
  );
}
