import { useEffect, useState } from "preact/hooks";
import type { ShippedGrammar } from "../../../../wire/generated";
import { shippedGrammars } from "../../../document/grammar/grammar-api";
import type { Grammars } from "../../../document/grammar/grammars-of";
import { explained } from "../../../problems/explained";
import type { Studio } from "../../../studio";
import { SHIPPED_GRAMMARS } from "../../../words/grammars";
import { softly } from "../../../words/joints";
import { language, say } from "../../../words/say";
import { DraftList } from "./draft-list";
import { ACCEPTED, openGrammar, openText, replaceText } from "./grammar-file";

/** A plant to begin with: the least that branches. */
const BEGINNING = `title: My plant
a = 30
slider: a 5 90
derivation length: 6
scale: 2

axiom: A
A --> F[+(a)A]/(137.5)A
`;

interface GrammarsProps {
  readonly studio: Studio;
  readonly grammars: Grammars;
}

let known: readonly ShippedGrammar[] | null = null;

/** Grammars in pictures, to plant one of them; and ways to bring one's own. */
export function GrammarGrid({ studio, grammars: { editing } }: GrammarsProps) {
  const [all, setAll] = useState(known);
  useEffect(() => {
    if (known === null) {
      shippedGrammars()
        .then((shipped) => {
          known = shipped;
          setAll(shipped);
        })
        .catch((error) => explained(error).then((text) => studio.toasts.show(text)));
    }
  }, [studio]);
  const inForce = studio.grammar.inForce.value?.text;
  return (
    <>
      <p class="quiet advice">{say("grammars.pick")}</p>
      <div class="grammar-acts">
        <button type="button" class="small" onClick={() => openText(studio, editing, BEGINNING)}>
          {say("grammars.own")}
        </button>
        <label class="small grammar-file">
          {say("grammars.open")}
          <input
            type="file"
            accept={ACCEPTED}
            onChange={({ currentTarget }) => {
              const file = currentTarget.files?.[0];
              currentTarget.value = "";
              void openGrammar(studio, editing, file);
            }}
          />
        </label>
        {"clipboard" in navigator && (
          <button type="button" class="small" onClick={() => void paste(studio, editing)}>
            {say("grammars.paste")}
          </button>
        )}
      </div>
      <DraftList studio={studio} editing={editing} />
      {all === null && <p class="quiet advice">{say("grammars.looking")}</p>}
      <ul class="grammar-grid">
        {all?.map((one) => (
          <li key={one.name}>
            <button
              type="button"
              class="grammar-card"
              data-grammar={one.name}
              aria-pressed={one.text === inForce}
              onClick={() => replaceText(studio, editing, one.text)}
            >
              <img src={one.picture} alt="" loading="lazy" decoding="async" draggable={false} />
              <b>{softly(titleIn(one))}</b>
              <span>{aboutIn(one)}</span>
              <em>{slidersText(one.sliders.length)}</em>
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}

async function paste(studio: Studio, editing: Grammars["editing"]): Promise<void> {
  const text = await navigator.clipboard.readText().catch(() => "");
  if (text.trim() === "") {
    studio.toasts.show(say("grammars.paste.none"));
  } else {
    openText(studio, editing, text.replace(/\r\n?/g, "\n"));
  }
}

/** What one is called in the language spoken now. */
function titleIn({ name, title }: ShippedGrammar): string {
  return (language.value === "de" && SHIPPED_GRAMMARS[name]?.[0]) || title;
}

function aboutIn({ name, about }: ShippedGrammar): string {
  return (language.value === "de" && SHIPPED_GRAMMARS[name]?.[1]) || about;
}

function slidersText(count: number): string {
  return say(count === 0 ? "grammars.sliders.none" : count === 1 ? "grammars.sliders.one" : "grammars.sliders.many", {
    count,
  });
}
