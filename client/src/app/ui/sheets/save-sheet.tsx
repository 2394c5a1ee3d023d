import { useCallback, useEffect, useState } from "preact/hooks";
import { type Belonging, belongingOf, isOvertaken, regardless, type Saving } from "../../library/belonging";
import { saveAsNew, saveAsNext } from "../../library/save-tree";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { momentText } from "../../words/date-text";
import { say } from "../../words/say";
import { NameField, usualName } from "./name-field";
import { Overtaken } from "./overtaken";
import { SaidFields } from "./said-fields";

/** Saves the tree: as the next version of the one it belongs to, or as a new one. */
export function SaveSheet({ studio }: { studio: Studio }) {
  const belonging = useBelonging(studio);
  const [name, setName] = useState(() => studio.trees.name.peek() ?? usualName(studio));
  const [note, setNote] = useState("");
  const [anew, setAnew] = useState(false);
  const [saving, setSaving] = useState(false);
  const trimmed = name.trim();
  const of = anew ? null : belonging.of;

  const attempt = async (work: (session: string) => Promise<string | null>) => {
    const session = studio.link.session.peek();
    if (session === null || saving) {
      return;
    }
    setSaving(true);
    try {
      const done = await work(session);
      if (done !== null) {
        studio.toasts.show(done);
        // The user may have closed the sheet meanwhile and opened another one.
        if (studio.layout.sheet.peek() === "save") {
          studio.layout.sheet.value = null;
        }
      }
    } catch (error) {
      studio.toasts.show(sentence(error));
    }
    setSaving(false);
  };
  const save = async (event: Event) => {
    event.preventDefault();
    if (of) {
      await attempt(async (session) => {
        const done = await saveAsNext(studio, session, isOvertaken(of) ? regardless(of) : of, note);
        return savedNote(of, done, belonging.set);
      });
    } else if (trimmed !== "") {
      await attempt(async (session) => {
        await saveAsNew(studio, session, trimmed, note);
        return say("sheets.save.done", { name: trimmed });
      });
    }
  };

  if (belonging.of === undefined) {
    return <Looking belonging={belonging} />;
  }
  const next = (of?.tree.version ?? 0) + 1;
  return (
    <form class="stack" onSubmit={save}>
      {of ? <Standing studio={studio} of={of} /> : <NameField name={name} onInput={setName} />}
      <SaidFields studio={studio} note={note} onNote={setNote} />
      {!of && <p class="quiet">{say("sheets.save.advice")}</p>}
      <div class="actions">
        {belonging.of !== null && studio.rights.mayBegin && (
          <button type="button" class="small" disabled={saving} onClick={() => setAnew(!anew)}>
            {say(anew ? "sheets.save.as-version" : "sheets.save.as-new", { name: belonging.of.tree.name })}
          </button>
        )}
        <button type="submit" class="primary" disabled={saving || (!of && trimmed === "")}>
          {saving
            ? say("sheets.save.saving")
            : of
              ? say(isOvertaken(of) ? "sheets.save.regardless" : "sheets.save.next", { number: next })
              : say("sheets.save.act")}
        </button>
      </div>
    </form>
  );
}

/** The note about the next version being saved; null where the user has to choose anew. */
function savedNote(of: Belonging, saving: Saving, set: (of: Belonging) => void): string | null {
  if ("overtaken" in saving) {
    set(saving.overtaken);
    return null;
  }
  return say("sheets.save.done.next", { name: of.tree.name, number: saving.version.number });
}

/** Which tree the one on the page is, and how it stands to what is saved of it. */
function Standing({ studio, of }: { readonly studio: Studio; readonly of: Belonging }) {
  const { tree, version, saved } = of;
  if (isOvertaken(of)) {
    return (
      <>
        <p class="standing">{tree.name}</p>
        <Overtaken studio={studio} belonging={of} />
      </>
    );
  }
  return (
    <div>
      <p class="standing">{tree.name}</p>
      <p class="quiet">
        {say(saved ? "sheets.save.same" : "sheets.save.since", { number: version, time: momentText(tree.saved_at) })}
      </p>
    </div>
  );
}

/** Until it is known which tree it is; and why it is not. */
export function Looking({ belonging: { failure, again } }: { readonly belonging: ReturnType<typeof useBelonging> }) {
  return failure === null ? (
    <p class="quiet empty">{say("notices.looking")}</p>
  ) : (
    <div class="actions">
      <p role="alert">{sentence(failure)}</p>
      <button type="button" class="small" onClick={again}>
        {say("sheets.library.again")}
      </button>
    </div>
  );
}

/** The tree of the library that the one on the page belongs to: undefined until that is known. */
export function useBelonging(studio: Studio) {
  const [of, set] = useState<Belonging | null | undefined>(undefined);
  const [failure, fail] = useState<unknown>(null);
  const again = useCallback(() => {
    const session = studio.link.session.peek();
    fail(null);
    const look = async () => (session === null ? null : await belongingOf(session));
    look().then(set, fail);
  }, [studio]);
  useEffect(again, [again]);
  return { of, set, failure, again };
}
