import { useEffect, useRef, useState } from "preact/hooks";
import { type NumberParameter, patchFor, shownValue } from "../growth-parameters";
import type { Studio } from "../studio";

/** How often a slider that is being pushed is sent, in milliseconds. */
const SEND_EVERY = 150;
/** How long the hand's own value stands against the server's after the last push. */
const SETTLES_AFTER = 800;

/** A slider for one number; the plant's own value is shown again as soon as the hand rests. */
export function NumberField({ studio, parameter }: { studio: Studio; parameter: NumberParameter }) {
  const { name, label, symbol, least, most, step, hint } = parameter;
  const [pushed, setPushed] = useState<number | null>(null);
  const [sending, settling] = [useRef(0), useRef(0)];
  const latest = useRef(0);
  const value = pushed ?? studio.parameters.value?.[name] ?? least;
  useEffect(
    () => () => {
      clearTimeout(sending.current);
      clearTimeout(settling.current);
    },
    [sending, settling],
  );

  const send = () => {
    clearTimeout(sending.current);
    sending.current = 0;
    const now = studio.parameters.peek();
    if (now) {
      studio.setParameters(patchFor(name, latest.current, now));
    }
  };
  const push = (to: number) => {
    latest.current = to;
    setPushed(to);
    if (sending.current === 0) {
      sending.current = window.setTimeout(send, SEND_EVERY);
    }
    clearTimeout(settling.current);
    settling.current = window.setTimeout(() => setPushed(null), SETTLES_AFTER);
  };
  const place = (value - least) / (most - least);
  return (
    <label class="number" title={hint}>
      <span class="number-head">
        <span>
          {label} {symbol && <i>{symbol}</i>}
        </span>
        <output>{shownValue(parameter, value)}</output>
      </span>
      <input
        type="range"
        min={least}
        max={most}
        step={step}
        value={value}
        style={{ "--place": `${100 * Math.min(1, Math.max(0, place))}%` }}
        onInput={(event) => push(Number(event.currentTarget.value))}
        onChange={() => {
          if (sending.current !== 0) {
            send();
          }
        }}
      />
      <span class="number-hint">{hint}</span>
    </label>
  );
}
