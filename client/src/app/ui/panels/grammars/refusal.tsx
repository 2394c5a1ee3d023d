import type { GrammarEditing } from "../../../document/grammar/grammar-editing";
import type { Studio } from "../../../studio";
import { endText } from "../../../words/grammar-problems";
import { say } from "../../../words/say";

interface RefusalProps {
  readonly studio: Studio;
  readonly editing: GrammarEditing;
}

/** Why the text in the editor could not be planted, what stands instead, and how deep it can be planted. */
export function Refusal({ studio, editing }: RefusalProps) {
  const refused = editing.refused.value;
  if (refused === null) {
    return null;
  }
  const inForce = studio.grammar.inForce.value;
  const ends = inForce?.ends ?? null;
  const depth = editing.possibleDepth;
  return (
    <div class="grammar-refusal" role="status">
      <p>
        {ends === null
          ? say("grammars.refused", { depth: refused.depth })
          : say("grammars.refused.why", { depth: refused.depth, why: endText(ends) })}
        {inForce !== null && <> {say("grammars.refused.stands", { depth: inForce.depth })}</>}
      </p>
      {depth !== null && (
        <button
          type="button"
          class="small"
          disabled={!studio.link.connected || editing.theirs.value !== null}
          onMouseDown={(event) => event.preventDefault()}
          onClick={() => editing.plant(depth)}
        >
          {say("grammars.refused.plant", { depth })}
        </button>
      )}
    </div>
  );
}
