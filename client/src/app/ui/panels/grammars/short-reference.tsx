import { signal } from "@preact/signals";
import { FUNCTIONS } from "../../../document/grammar/grammar-names";
import { LINES, SIGNS } from "../../../words/grammar-signs";
import { say } from "../../../words/say";

/** Whether it is shown; it outlasts the panel. */
export const reference = signal(false);

/** The language at a glance, above the text: lines, signs and functions. */
export function ShortReference() {
  return (
    <section class="grammar-reference" aria-label={say("grammars.reference")}>
      <h3>{say("grammars.reference.lines")}</h3>
      <dl>
        {LINES.map(([line, says]) => (
          <div key={line}>
            <dt>{line}</dt>
            <dd>{say(says)}</dd>
          </div>
        ))}
      </dl>
      <h3>{say("grammars.reference.signs")}</h3>
      <dl class="grammar-signs">
        {SIGNS.map(([sign, does]) => (
          <div key={sign}>
            <dt>{sign}</dt>
            <dd>{say(does)}</dd>
          </div>
        ))}
      </dl>
      <h3>{say("grammars.reference.functions")}</h3>
      <p>
        <code>{[...FUNCTIONS.keys()].join(" ")}</code>
      </p>
    </section>
  );
}
