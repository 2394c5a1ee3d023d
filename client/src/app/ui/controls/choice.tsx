import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { softly } from "../../words/joints";
import { Field } from "./field";

export interface Option<Value extends string> {
  readonly value: Value;
  readonly label: string;
  readonly picture?: ComponentChildren;
}

interface ChoiceProps<Value extends string> {
  readonly label: string;
  readonly options: readonly Option<Value>[];
  readonly value: Value;
  /** What reset puts it back to. */
  readonly standard: Value;
  /** What it does, in one sentence. */
  readonly help: string;
  /** How many stand side by side. */
  readonly columns?: number;
  readonly onCommit: (value: Value) => void;
}

/** One of a few, each with its picture. */
export function Choice<Value extends string>(props: ChoiceProps<Value>) {
  const { label, options, value, standard, help, columns = Math.min(4, options.length), onCommit } = props;
  const name = useId();
  return (
    <Field label={label} help={help} onReset={standard === value ? undefined : () => onCommit(standard)}>
      {(description) => (
        <div
          class="choice"
          role="radiogroup"
          aria-label={label}
          aria-describedby={description}
          style={{ "--columns": columns }}
        >
          {options.map((option) => (
            <label key={option.value} data-picture={option.picture !== undefined}>
              <input
                type="radio"
                aria-label={option.label}
                name={name}
                value={option.value}
                checked={option.value === value}
                onChange={() => onCommit(option.value)}
              />
              {option.picture}
              <span>{softly(option.label)}</span>
            </label>
          ))}
        </div>
      )}
    </Field>
  );
}
