import type { Grammars } from "../../../document/grammar/grammars-of";
import type { Studio } from "../../../studio";
import { companions } from "../../../together/people";
import { say } from "../../../words/say";
import { offerAside, saveGrammar } from "./grammar-file";
import { reference } from "./short-reference";

/** What is said and done above the text: whether the plant follows, rules and branches, saving; and who else writes. */
export function EditorHead({ studio, grammars: { editing, origins } }: { studio: Studio; grammars: Grammars }) {
  const writer = companions(studio.together.people.value).find(({ device }) => device.tool === "grammar");
  const theirs = editing.theirs.value;
  return (
    <>
      <div class="grammar-head">
        <label class="grammar-live" title={say("grammars.live.title")}>
          <span class="switch-box">
            <input
              type="checkbox"
              checked={editing.live.value}
              onChange={({ currentTarget }) => {
                editing.live.value = currentTarget.checked;
              }}
            />
            <span class="switch-knob" aria-hidden="true" />
          </span>
          {say("grammars.live")}
        </label>
        <button
          type="button"
          class="small"
          aria-pressed={origins.wanted.value}
          title={say("grammars.rules.title")}
          disabled={studio.grammar.inForce.value === null}
          onClick={() => {
            origins.wanted.value = !origins.wanted.peek();
          }}
        >
          {say("grammars.rules")}
        </button>
        <button
          type="button"
          class="small"
          aria-label={say("grammars.reference")}
          title={say("grammars.reference")}
          aria-pressed={reference.value}
          onClick={() => {
            reference.value = !reference.peek();
          }}
        >
          ?
        </button>
        <button
          type="button"
          class="small"
          title={say("grammars.save.title")}
          disabled={editing.text.value.trim() === ""}
          onClick={() => saveGrammar(editing.text.peek())}
        >
          {say("grammars.save")}
        </button>
      </div>
      {theirs !== null ? (
        <div class="grammar-theirs" role="alert">
          <p>{say("grammars.theirs", { name: writer?.name ?? say("grammars.theirs.somebody") })}</p>
          <button type="button" class="small" onClick={() => takeTheirs(studio, editing)}>
            {say("grammars.theirs.take")}
          </button>
          <button type="button" class="small" onClick={() => editing.keepMine()}>
            {say("grammars.theirs.keep")}
          </button>
        </div>
      ) : (
        writer && (
          <p class="grammar-writer" role="status" style={{ "--person": writer.colour }}>
            <i class="person-dot" />
            {say("grammars.writing", { name: writer.name })}
          </p>
        )
      )}
    </>
  );
}

/** Theirs goes into the editor; mine can be brought back. */
function takeTheirs(studio: Studio, editing: Grammars["editing"]): void {
  editing.takeTheirs();
  offerAside(studio, editing);
}
