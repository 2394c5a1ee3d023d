import { Field } from "./field";

interface SwitchProps {
  readonly label: string;
  readonly value: boolean;
  /** What reset puts it back to. */
  readonly standard: boolean;
  /** What it does, in one sentence. */
  readonly help: string;
  readonly onCommit: (value: boolean) => void;
}

/** Something that is on or off. */
export function Switch({ label, value, standard, help, onCommit }: SwitchProps) {
  return (
    <Field
      label={label}
      help={help}
      onReset={value === standard ? undefined : () => onCommit(standard)}
      end={(description) => (
        <label class="switch-box">
          <input
            type="checkbox"
            aria-label={label}
            aria-describedby={description}
            checked={value}
            onChange={(event) => onCommit(event.currentTarget.checked)}
          />
          <span class="switch-knob" aria-hidden="true" />
        </label>
      )}
    />
  );
}
