import { grammarsOf } from "../../document/grammar/grammars-of";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** The depth of the grammar in force: one less goes back in time, one more derives it further. */
export function DepthStepper({ studio }: { studio: Studio }) {
  const { depth } = grammarsOf(studio);
  const shown = depth.shown.value;
  return (
    <fieldset class="depth-stepper" aria-label={say("grammars.depth")}>
      <button
        type="button"
        class="tool"
        aria-label={say("grammars.depth.less")}
        title={say("grammars.depth.less")}
        aria-disabled={shown <= 0}
        onClick={() => shown > 0 && depth.by(-1)}
      >
        −
      </button>
      <output aria-live="polite" data-under-way={depth.wanted.value !== null}>
        <small>{say("grammars.depth")}</small>
        {shown}
      </output>
      <button
        type="button"
        class="tool"
        aria-label={say("grammars.depth.more")}
        title={say("grammars.depth.more")}
        onClick={() => depth.by(1)}
      >
        +
      </button>
    </fieldset>
  );
}
