import { useState } from "preact/hooks";
import { say } from "../../words";
import { numberText, onStep, typedNumber, unitText } from "./number-text";

/** How a number is written down and read. */
export interface Notation {
  write(value: number): string;
  /** What was typed as a number; null if it is none. */
  read(text: string): number | null;
}

interface TypedNumberProps {
  readonly label: string;
  readonly unit: string;
  readonly least: number;
  readonly most: number;
  readonly step: number;
  readonly value: number;
  readonly disabled?: boolean;
  readonly notation?: Notation | undefined;
  readonly onCommit: (value: number) => void;
}

/** A number in a box, typed over when it is touched. */
export function TypedNumber(props: TypedNumberProps) {
  const { label, unit, least, most, step, value, disabled = false, onCommit } = props;
  const { write, read } = props.notation ?? { write: (number: number) => numberText(number, step), read: typedNumber };
  const [typed, setTyped] = useState<string | null>(null);
  const text = write(value);
  const set = (to: number) => {
    const next = onStep(to, least, most, step);
    if (next !== onStep(value, least, most, step)) {
      onCommit(next);
    }
  };
  const finish = () => {
    const to = typed === null ? null : read(typed);
    setTyped(null);
    if (to !== null) {
      set(to);
    }
  };
  return (
    <label class="typed" data-close={unit === "°"}>
      <input
        type="text"
        inputMode={least < 0 ? "text" : "decimal"}
        autocomplete="off"
        aria-label={say("controls.value", { name: label })}
        style={{ width: `${Math.max(write(least).length, write(most).length) + 0.5}ch` }}
        value={typed ?? text}
        disabled={disabled}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={finish}
        onKeyDown={(event) => {
          const notches = { ArrowUp: 1, ArrowDown: -1 }[event.key];
          if (event.key === "Enter") {
            finish();
            event.currentTarget.select();
          } else if (event.key === "Escape") {
            setTyped(null);
          } else if (notches !== undefined) {
            event.preventDefault();
            set((typed === null ? value : (read(typed) ?? value)) + notches * step);
            setTyped(null);
          }
        }}
      />
      {unit !== "" && <span aria-hidden="true">{unitText(unit).trim()}</span>}
    </label>
  );
}
