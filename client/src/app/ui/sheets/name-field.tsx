import { MAX_NAME_CHARACTERS } from "../../../wire/generated";
import type { Studio } from "../../studio";
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

/** What a tree is called that nobody names: as the grammar in force calls itself, or by the day. */
export function usualName({ grammar }: Pick<Studio, "grammar">): string {
  const title = grammar.inForce.peek()?.title?.trim();
  if (title) {
    return [...title].slice(0, MAX_NAME_CHARACTERS).join("");
  }
  return say("sheets.save.default", { date: dateText(new Date().toISOString()) });
}
