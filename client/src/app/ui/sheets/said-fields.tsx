import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { LONGEST_NOTE } from "./library/card-form";

interface SaidFieldsProps {
  readonly studio: Studio;
  readonly note: string;
  readonly onNote: (note: string) => void;
}

/** What is said of what is saved, and by whom; neither need be. */
export function SaidFields({ studio, note, onNote }: SaidFieldsProps) {
  const { author } = studio.settings;
  return (
    <>
      <label class="field">
        <span>{say("sheets.save.note")}</span>
        <textarea
          rows={2}
          value={note}
          maxLength={LONGEST_NOTE}
          onInput={(event) => onNote(event.currentTarget.value)}
        />
      </label>
      <label class="field">
        <span>{say("sheets.save.author")}</span>
        <input
          type="text"
          value={author.value}
          maxLength={80}
          autocomplete="nickname"
          onInput={(event) => {
            author.value = event.currentTarget.value;
          }}
        />
      </label>
    </>
  );
}
