import type { ComponentChildren } from "preact";
import { useId, useState } from "preact/hooks";
import { softly } from "../../words/joints";
import { say } from "../../words/say";
import { ResetIcon } from "./icons";

interface FieldProps {
  readonly label: string;
  /** The letter it has in formulas. */
  readonly symbol?: string | undefined;
  /** What it does, in one sentence; it unfolds when the name is touched. */
  readonly help: string;
  /** Puts the value back to what it was before anyone changed it; absent where it is that already. */
  readonly onReset: (() => void) | undefined;
  /** What stands at the end of the name's line; as the control itself it is given what describes it. */
  readonly end?: ComponentChildren | ((descriptionId: string) => ComponentChildren);
  /** The control, where it stands under its name. */
  readonly children?: (descriptionId: string) => ComponentChildren;
}

/** A control's name with its help and reset, and the control under it. */
export function Field({ label, symbol, help, onReset, end, children }: FieldProps) {
  const helpId = useId();
  const [open, setOpen] = useState(false);
  const name = (
    <span>
      {softly(label)}
      {symbol && <i> {symbol}</i>}
    </span>
  );
  return (
    <div class="control">
      <div class="field-head">
        <button
          type="button"
          class="field-name"
          aria-expanded={open}
          aria-controls={helpId}
          title={help}
          onClick={() => setOpen(!open)}
        >
          {name}
          <b aria-hidden="true">?</b>
        </button>
        {onReset && <ResetButton name={label} onReset={onReset} />}
        {typeof end === "function" ? end(helpId) : end}
      </div>
      <p class="field-help" id={helpId} hidden={!open}>
        {help}
      </p>
      {children?.(helpId)}
    </div>
  );
}

interface ResetProps {
  readonly name: string;
  readonly onReset: () => void;
}

/** Puts something back to what it was before anyone changed it. */
export function ResetButton({ name, onReset }: ResetProps) {
  const text = say("controls.reset", { name });
  return (
    <button
      type="button"
      class="field-reset"
      aria-label={text}
      title={text}
      onClick={(event) => {
        // The button goes with what it resets, and must not take the focus with it.
        if (document.activeElement === event.currentTarget) {
          controlBeside(event.currentTarget)?.focus();
        }
        onReset();
      }}
    >
      <ResetIcon />
    </button>
  );
}

/** What the user sets things with; not where it types, for there the keys of a tablet would come up. */
const CONTROL = 'input[type="range"], input[type="checkbox"], input[type="radio"]:checked, [role="slider"]';

/** The control that a button stands beside, else the nearest other one. */
function controlBeside(button: HTMLElement): HTMLElement | null {
  for (let around = button.parentElement; around !== null; around = around.parentElement) {
    const control = around.querySelector<HTMLElement>(CONTROL) ?? around.querySelector<HTMLElement>(".field-name");
    if (control !== null && !around.classList.contains("field-head")) {
      return control;
    }
  }
  return null;
}
