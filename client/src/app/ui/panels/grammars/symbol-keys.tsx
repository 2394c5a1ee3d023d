import type { RefObject } from "preact";
import { SIGNS } from "../../../words/grammar-signs";
import { say } from "../../../words/say";

/** What closes behind a selection that is put between signs. */
const CLOSING: Readonly<Record<string, string>> = { "[": "]", "(": ")", "{": "}" };

/** A row of signs above the keyboard. It never takes the focus, so that the keyboard stays. */
export function SymbolKeys({ area }: { readonly area: RefObject<HTMLTextAreaElement | null> }) {
  const stay = (event: Event) => event.preventDefault();
  return (
    <div class="grammar-keys" role="toolbar" aria-label={say("grammars.keys")}>
      {SIGNS.map(([sign, does]) => (
        <button
          type="button"
          key={sign}
          tabIndex={-1}
          aria-label={say("grammars.key", { sign, does: say(does) })}
          onPointerDown={(event) => event.pointerType === "mouse" && stay(event)}
          onMouseDown={stay}
          onClick={() => area.current && insert(area.current, sign)}
        >
          {sign}
        </button>
      ))}
    </div>
  );
}

/** Puts a sign where the caret stands, or around what is selected, so that the field's own undo knows of it. */
export function insert(field: HTMLTextAreaElement, sign: string): void {
  const selected = field.value.slice(field.selectionStart, field.selectionEnd);
  const closing = selected === "" ? "" : (CLOSING[sign] ?? "");
  const text = sign === "-->" ? arrowAt(field) : closing === "" ? sign : `${sign}${selected}${closing}`;
  field.focus({ preventScroll: true });
  if (!document.execCommand("insertText", false, text)) {
    field.setRangeText(text, field.selectionStart, field.selectionEnd, "end");
    field.dispatchEvent(new InputEvent("input", { bubbles: true }));
  }
}

/** An arrow with the blanks that are not there yet. */
function arrowAt({ value, selectionStart, selectionEnd }: HTMLTextAreaElement): string {
  const before = /\S$/.test(value.slice(0, selectionStart)) ? " " : "";
  const behind = value[selectionEnd] === " " ? "" : " ";
  return `${before}-->${behind}`;
}
