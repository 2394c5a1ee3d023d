import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { tokens } from "../../../document/grammar/grammar-tokens";
import type { Grammars } from "../../../document/grammar/grammars-of";
import { carriedCaret, pieces, problemAt, rangeOf } from "../../../document/grammar/text-place";
import { asMeant } from "../../../document/grammar/typed";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { EditorHead } from "./editor-head";
import { EditorState } from "./editor-state";
import { useRules } from "./rule-glass";
import { reference, ShortReference } from "./short-reference";
import { SymbolKeys } from "./symbol-keys";

/** What stands where nothing was written yet. */
const EXAMPLE = "axiom: A\nA --> F[+A][-A]A";

interface EditorProps {
  readonly studio: Studio;
  readonly grammars: Grammars;
}

/** Scrolls the layer so far that a place in its text is in sight. */
function reveal(layer: HTMLElement, place: number): void {
  const around = layer.closest(".grammar-scroll");
  let left = place;
  for (const span of layer.children) {
    const text = span.firstChild;
    const length = text?.textContent?.length ?? 0;
    if (!text || !around || left > length) {
      left -= length;
      continue;
    }
    const range = document.createRange();
    range.setStart(text, left);
    range.collapse(true);
    // A place at the end of a line has no box of its own; then that of its piece is near enough.
    const box = range.getClientRects()[0] ?? span.getBoundingClientRect();
    const seen = around.getBoundingClientRect();
    around.scrollBy({ top: Math.max(0, box.bottom + 12 - seen.bottom) + Math.min(0, box.top - 12 - seen.top) });
    return;
  }
}

/** The text of a grammar: typed over a layer with the same letters in colours, with what is wrong underlined. */
export function GrammarEditor({ studio, grammars }: EditorProps) {
  const { editing, origins } = grammars;
  const area = useRef<HTMLTextAreaElement>(null);
  const layer = useRef<HTMLPreElement>(null);
  const [caret, setCaret] = useState<number | null>(null);
  const text = editing.text.value;
  const problems = editing.problems.value;
  const ranges = useMemo(() => problems.map((problem) => rangeOf(text, problem)), [text, problems]);
  const looked = origins.range(text);
  const shown = useMemo(() => pieces(tokens(text), ranges, looked), [text, ranges, looked?.from, looked?.to]);
  const at = caret === null ? null : problemAt(ranges, caret);
  useRules(studio, grammars, layer);
  useEffect(() => editing.look(), [editing]);
  // What others set, or a file, comes into the field without moving the caret away from what it stood at.
  useEffect(
    () =>
      editing.text.subscribe((text) => {
        const field = area.current;
        if (field && field.value !== text) {
          const [from, to] = [field.selectionStart, field.selectionEnd];
          const before = field.value;
          field.value = text;
          if (document.activeElement === field) {
            field.setSelectionRange(carriedCaret(before, text, from), carriedCaret(before, text, to));
          }
        }
      }),
    [editing],
  );
  const follow = () => {
    const field = area.current;
    if (field && document.activeElement === field) {
      setCaret(field.selectionStart === field.selectionEnd ? field.selectionStart : null);
      if (origins.wanted.peek()) {
        origins.lookAt(field.value, field.selectionStart);
      }
    }
  };
  useEffect(() => {
    document.addEventListener("selectionchange", follow);
    return () => document.removeEventListener("selectionchange", follow);
  });
  // What is said below the text takes room from it; the line that is written stays in sight.
  useEffect(() => {
    const field = area.current;
    if (field && layer.current && document.activeElement === field) {
      reveal(layer.current, field.selectionEnd);
    }
  }, [at, problems.length]);
  /** Moves the caret to a place and brings it into sight. */
  const goTo = (problem: number) => {
    const range = ranges[problem];
    if (range && area.current) {
      area.current.focus({ preventScroll: true });
      area.current.setSelectionRange(range.from, range.from);
      setCaret(range.from);
      layer.current?.querySelector(`[data-problem="${problem}"]`)?.scrollIntoView({ block: "center" });
    }
  };
  return (
    <div class="grammar-editor" data-live={editing.live.value}>
      <EditorHead studio={studio} grammars={grammars} />
      <div class="grammar-read">
        {reference.value && <ShortReference />}
        <div class="grammar-scroll">
          <div class="grammar-page">
            <pre class="grammar-layer" ref={layer} aria-hidden="true">
              {shown.map(({ from, to, kind, nesting, problem, looked }) => (
                <span
                  key={from}
                  data-kind={kind}
                  data-nesting={nesting === undefined ? undefined : nesting % 4}
                  data-problem={problem}
                  data-severity={problem === undefined ? undefined : problems[problem]?.severity}
                  data-looked={looked}
                >
                  {text.slice(from, to)}
                </span>
              ))}
              {"\n"}
            </pre>
            <textarea
              ref={area}
              class="grammar-area"
              aria-label={say("grammars.text")}
              aria-invalid={editing.hasErrors.value}
              spellcheck={false}
              autocapitalize="off"
              autocomplete="off"
              {...{ autocorrect: "off" }}
              placeholder={EXAMPLE}
              onInput={(event) => {
                const field = event.currentTarget;
                const meant = asMeant(field.value, field.selectionStart);
                if (meant.text !== field.value && !event.isComposing) {
                  field.value = meant.text;
                  field.setSelectionRange(meant.caret, meant.caret);
                }
                editing.type(field.value);
                follow();
              }}
              onBlur={() => editing.endBout()}
              onKeyDown={(event) => {
                // The page's own keys are not for what is typed here.
                event.stopPropagation();
                if (event.key === "Escape") {
                  event.currentTarget.blur();
                }
              }}
            />
          </div>
        </div>
      </div>
      <EditorState studio={studio} grammars={grammars} at={at} goTo={goTo} />
      <SymbolKeys area={area} />
    </div>
  );
}
