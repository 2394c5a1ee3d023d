import { MAX_NAME_CHARACTERS, MAX_NOTE_CHARACTERS } from "../../../wire/generated";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

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
          maxLength={MAX_NOTE_CHARACTERS}
          onInput={(event) => onNote(event.currentTarget.value)}
        />
      </label>
      <label class="field">
        <span>{say("sheets.save.author")}</span>
        <input
          type="text"
          value={author.value}
          maxLength={MAX_NAME_CHARACTERS}
          autocomplete="nickname"
          onInput={(event) => {
            author.value = event.currentTarget.value;
          }}
        />
      </label>
    </>
  );
}
