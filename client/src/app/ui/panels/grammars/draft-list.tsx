import type { GrammarEditing } from "../../../document/grammar/grammar-editing";
import { nameIn } from "../../../document/grammar/typed";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { takeUp } from "./grammar-file";
import { tab } from "./tab";

interface DraftsProps {
  readonly studio: Studio;
  readonly editing: GrammarEditing;
}

/** Texts that no tree has: the one in the editor, and those that others took the place of. */
export function DraftList({ studio, editing }: DraftsProps) {
  const here = editing.text.value;
  const standsHere = !editing.isPlanted.value && here.trim() !== "";
  const { aside } = editing;
  if (!standsHere && aside.length === 0) {
    return null;
  }
  return (
    <section class="grammar-drafts" aria-label={say("grammars.drafts")}>
      <h3>{say("grammars.drafts")}</h3>
      <ul>
        {standsHere && (
          <li>
            <button
              type="button"
              class="small"
              onClick={() => {
                tab.value = "text";
              }}
            >
              <b>{nameIn(here)}</b>
              <span>{say("grammars.drafts.here")}</span>
            </button>
          </li>
        )}
        {aside.map((text) => (
          <li key={text}>
            <button type="button" class="small" onClick={() => takeUp(studio, editing, text)}>
              <b>{nameIn(text)}</b>
              <span>{linesText(text)}</span>
            </button>
            <button
              type="button"
              class="small"
              aria-label={say("grammars.drafts.discard", { name: nameIn(text) })}
              title={say("grammars.drafts.discard", { name: nameIn(text) })}
              onClick={() => {
                editing.discard(text);
                studio.toasts.show(say("grammars.drafts.discarded"), {
                  label: say("grammars.bring-back"),
                  act: () => editing.keep(text),
                });
              }}
            >
              ✕
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function linesText(text: string): string {
  const count = text.trim().split("\n").length;
  return say(count === 1 ? "grammars.drafts.line" : "grammars.drafts.lines", { count });
}
