import { MAX_NAME_CHARACTERS } from "../../../wire/generated";
import { dateText } from "../../words/date-text";
import { say } from "../../words/say";

interface NameFieldProps {
  readonly name: string;
  readonly onInput: (name: string) => void;
}

/** What a tree that is to be saved is called. */
export function NameField({ name, onInput }: NameFieldProps) {
  return (
    <label class="field">
      <span>{say("sheets.save.name")}</span>
      <input
        type="text"
        value={name}
        maxLength={MAX_NAME_CHARACTERS}
        autocomplete="off"
        enterkeyhint="done"
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => onInput(event.currentTarget.value)}
      />
    </label>
  );
}

/** What a tree is called that nobody names. */
export function usualName(): string {
  return say("sheets.save.default", { date: dateText(new Date().toISOString()) });
}
