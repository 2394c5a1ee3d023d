import { useRef } from "preact/hooks";
import { MAX_NAME_CHARACTERS, MAX_NOTE_CHARACTERS } from "../../../../wire/generated";
import { say } from "../../../words/say";

interface CardFormProps {
  readonly kind: "name" | "note";
  readonly label: string;
  readonly value: string;
  /** What was typed, if it is something else than before. */
  readonly onSave: (value: string) => void;
  readonly onEnd: () => void;
}

/** A row in which a name or a note is typed. */
export function CardForm({ kind, label, value, onSave, onEnd }: CardFormProps) {
  const form = useRef<HTMLFormElement>(null);
  const end = (event: SubmitEvent) => {
    event.preventDefault();
    const typed = new FormData(form.current ?? undefined).get("text")?.toString().trim() ?? value;
    if (typed !== value && (kind === "note" || typed !== "")) {
      onSave(typed);
    }
    onEnd();
  };
  const field = {
    name: "text",
    "aria-label": label,
    placeholder: label,
    autocomplete: "off",
    defaultValue: value,
    onKeyDown: (event: KeyboardEvent) => {
      if (event.key === "Escape") {
        event.preventDefault();
        onEnd();
      }
    },
  } as const;
  return (
    <form class="card-form" ref={form} onSubmit={end}>
      {kind === "name" ? (
        <input {...field} type="text" maxLength={MAX_NAME_CHARACTERS} ref={(input) => input?.focus()} />
      ) : (
        <textarea {...field} rows={3} maxLength={MAX_NOTE_CHARACTERS} ref={(area) => area?.focus()} />
      )}
      <button type="button" class="small" onClick={onEnd}>
        {say("library.cancel")}
      </button>
      <button type="submit" class="primary">
        {say("library.save")}
      </button>
    </form>
  );
}
