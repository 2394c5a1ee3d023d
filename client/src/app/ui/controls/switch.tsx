import { Field } from "./field";

interface SwitchProps {
  readonly label: string;
  readonly value: boolean;
  /** What it does, in one sentence. */
  readonly help?: string | undefined;
  readonly onCommit: (value: boolean) => void;
}

/** Something that is on or off. */
export function Switch({ label, value, help, onCommit }: SwitchProps) {
  return (
    <Field
      label={label}
      help={help}
      end={
        <label class="switch-box">
          <input
            type="checkbox"
            aria-label={label}
            checked={value}
            onChange={(event) => onCommit(event.currentTarget.checked)}
          />
          <span class="switch-knob" aria-hidden="true" />
        </label>
      }
    >
      {() => null}
    </Field>
  );
}
