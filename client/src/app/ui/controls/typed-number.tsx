import { useState } from "preact/hooks";
import { numberText, onStep, typedNumber, unitText } from "../../words/number-text";
import { say } from "../../words/say";

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
  /** Whether Enter does nothing else than to take what was typed, where it would send a form. */
  readonly staysOnEnter?: boolean;
  readonly onCommit: (value: number) => void;
}

/** A number in a box, typed over when it is touched. */
export function TypedNumber(props: TypedNumberProps) {
  const { label, unit, least, most, step, value, disabled = false, staysOnEnter = false, onCommit } = props;
  const { write, read } = props.notation ?? { write: (number: number) => numberText(number, step), read: typedNumber };
  const set = (to: number) => {
    const next = onStep(to, least, most, step);
    if (next !== onStep(value, least, most, step)) {
      onCommit(next);
    }
  };
  return (
    <Typed
      {...{ label, unit, disabled, staysOnEnter }}
      text={write(value)}
      width={Math.max(write(least).length, write(most).length)}
      inputMode={least < 0 ? "text" : "decimal"}
      onTyped={(typed) => {
        const to = read(typed);
        if (to !== null) {
          set(to);
        }
      }}
      onStep={(notches, typed) => set((typed === null ? value : (read(typed) ?? value)) + notches * step)}
    />
  );
}

interface TypedProps {
  /** The name of what is typed. */
  readonly label: string;
  readonly text: string;
  /** How many characters it may need. */
  readonly width: number;
  readonly unit?: string;
  readonly inputMode?: "text" | "decimal";
  readonly disabled?: boolean;
  readonly staysOnEnter?: boolean;
  /** What was typed over it, once that is done. */
  readonly onTyped: (typed: string) => void;
  /** An arrow key, with what was typed until then. */
  readonly onStep?: (notches: number, typed: string | null) => void;
}

/** A value in a box, typed over when it is touched. */
export function Typed(props: TypedProps) {
  const {
    label,
    text,
    width,
    unit = "",
    inputMode = "text",
    disabled = false,
    staysOnEnter = false,
    onTyped,
    onStep,
  } = props;
  const [typed, setTyped] = useState<string | null>(null);
  const finish = () => {
    setTyped(null);
    if (typed !== null) {
      onTyped(typed);
    }
  };
  return (
    <label class="typed" data-close={unit === "°"}>
      <input
        type="text"
        inputMode={inputMode}
        autocomplete="off"
        aria-label={say("controls.value", { name: label })}
        style={{ width: `${width + 0.5}ch` }}
        value={typed ?? text}
        disabled={disabled}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={finish}
        onKeyDown={(event) => {
          const notches = { ArrowUp: 1, ArrowDown: -1 }[event.key];
          if (event.key === "Enter") {
            if (staysOnEnter) {
              event.preventDefault();
            }
            finish();
            event.currentTarget.select();
          } else if (event.key === "Escape") {
            setTyped(null);
          } else if (notches !== undefined && onStep) {
            event.preventDefault();
            onStep(notches, typed);
            setTyped(null);
          }
        }}
      />
      {unit !== "" && <span aria-hidden="true">{unitText(unit).trim()}</span>}
    </label>
  );
}
