import { useEffect, useState } from "preact/hooks";
import type { GrammarDiagnostic } from "../../../../wire/generated";
import type { Grammars } from "../../../document/grammar/grammars-of";
import type { Studio } from "../../../studio";
import { endText, kindText, sentenceOf } from "../../../words/grammar-problems";
import { countText } from "../../../words/measure-text";
import { say } from "../../../words/say";
import { Refusal } from "./refusal";

interface StateProps {
  readonly studio: Studio;
  readonly grammars: Grammars;
  /** The problem that the caret stands in, by its number. */
  readonly at: number | null;
  readonly goTo: (problem: number) => void;
}

/** What there is to say of the text: that it is planted, or what is wrong with it and where. */
export function EditorState({ studio, grammars: { editing, origins }, at, goTo }: StateProps) {
  const [open, setOpen] = useState(false);
  const problems = editing.problems.value;
  const errors = problems.filter(({ severity }) => severity === "error").length;
  const here = at === null ? undefined : problems[at];
  const end = endOf(editing);
  // Those that come later are told where they stand; a list that opens by itself would take room from the text.
  const isClean = problems.length === 0;
  useEffect(() => {
    if (isClean) {
      setOpen(false);
    }
  }, [isClean]);
  const shownRule = origins.wanted.value && origins.line.value !== null;
  return (
    <div class="grammar-state">
      {open && problems.length > 0 && (
        <ul class="grammar-problems">
          {problems.map((problem, number) => (
            <li key={`${problem.line}:${problem.column}:${problem.code}`}>
              <button type="button" data-severity={problem.severity} onClick={() => goTo(number)}>
                <ProblemText problem={problem} />
              </button>
            </li>
          ))}
        </ul>
      )}
      {!open && here && (
        <p class="grammar-problem" role="status" data-severity={here.severity}>
          <ProblemText problem={here} />
        </p>
      )}
      <Refusal studio={studio} editing={editing} />
      {end !== null && editing.refused.value === null && (
        <p class="grammar-problem" role="status" data-severity="warning">
          {end}
        </p>
      )}
      {shownRule && <p class="grammar-made">{madeText(origins.rows.value.length)}</p>}
      <div class="grammar-line">
        {problems.length > 0 ? (
          <button
            type="button"
            class="grammar-count"
            data-severity={errors > 0 ? "error" : "warning"}
            aria-expanded={open}
            onMouseDown={keepFocus}
            onClick={() => {
              setOpen(!open);
              if (!open && problems.length === 1) {
                goTo(0);
              }
            }}
          >
            {countOf(errors, problems.length)}
          </button>
        ) : (
          <span class="quiet" role="status">
            {stateText(editing)}
          </span>
        )}
        {!editing.isPlanted.value && editing.text.value.trim() !== "" && (
          <button
            type="button"
            class="primary"
            onMouseDown={keepFocus}
            disabled={editing.hasErrors.value || editing.theirs.value !== null || !studio.link.connected}
            onClick={() => editing.plant()}
          >
            {say("grammars.plant")}
          </button>
        )}
      </div>
    </div>
  );
}

/** The keyboard of the screen stays while somebody asks what is wrong. */
function keepFocus(event: Event): void {
  event.preventDefault();
}

/** At which depth the text ends for a reason of its own, and why; nothing where it only grows too large. */
function endOf(editing: Grammars["editing"]): string | null {
  const sized = editing.sized.value;
  if (sized === null || sized.of !== editing.text.value || sized.report.ends === null) {
    return null;
  }
  const { ends, sizes } = sized.report;
  const depth = Math.max(0, sizes.length - 1);
  return ends.id === "ends.counted" ? null : say("grammars.depth.ends", { depth, why: endText(ends) });
}

function ProblemText({ problem }: { problem: GrammarDiagnostic }) {
  const { line, column, code } = problem;
  const { message, hint } = sentenceOf(problem);
  return (
    <>
      <b>
        {say("grammars.place", { line, column })} · {kindText(code)}
      </b>
      <span>
        <Quoting text={message} />
        {hint !== null && (
          <i>
            {" — "}
            <Quoting text={hint} isPart />
          </i>
        )}
      </span>
    </>
  );
}

/** A sentence in which pieces of the text stand between backticks. */
function Quoting({ text, isPart = false }: { text: string; isPart?: boolean }) {
  const whole = isPart ? text : text.charAt(0).toUpperCase() + text.slice(1);
  return <>{whole.split("`").map((part, i) => (i % 2 === 1 ? <code key={part}>{part}</code> : part))}</>;
}

function countOf(errors: number, all: number): string {
  if (errors > 0) {
    return say(errors === 1 ? "grammars.problems.one" : "grammars.problems.many", { count: errors });
  }
  return say(all === 1 ? "grammars.notes.one" : "grammars.notes.many", { count: all });
}

function stateText(editing: Grammars["editing"]): string {
  if (editing.text.value.trim() === "") {
    return say("grammars.state.empty");
  }
  if (editing.isPlanted.value) {
    return say("grammars.state.planted");
  }
  return say(editing.report.value?.of === editing.text.value ? "grammars.state.ahead" : "grammars.state.looking");
}

function madeText(count: number): string {
  const key = count === 0 ? "nothing" : count === 1 ? "one" : "many";
  return say(`grammars.rules.made.${key}`, { count: countText(count) });
}
