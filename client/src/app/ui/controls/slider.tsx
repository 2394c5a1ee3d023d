import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { numberText, onStep, unitText } from "../../words/number-text";
import { Field } from "./field";
import { placeOf, type Scale, stepsOf, valueAt } from "./travel";
import { type Notation, TypedNumber } from "./typed-number";

export interface SliderProps extends Scale {
  readonly label: string;
  readonly symbol?: string | undefined;
  readonly unit?: string | undefined;
  readonly value: number;
  /** What reset puts it back to. */
  readonly standard: number;
  /** What it does, in one sentence. */
  readonly help: string;
  readonly disabled?: boolean;
  /** The value in words, where a number alone says little. */
  readonly inWords?: (value: number) => string;
  /** Another way to write the value down, and to read what was typed. */
  readonly notation?: Notation | undefined;
  /** Words, or buttons that go there, under the track, from its least end to its most. */
  readonly marks?: ComponentChildren;
  /** Another colouring of the track. */
  readonly track?: string;
  /** The value as the user moves it. */
  readonly onDrag?: (value: number) => void;
  /** Another way back to the standard than to commit it. */
  readonly onReset?: () => void;
  /** The value when the user lets go, or one that was typed or reset. */
  readonly onCommit: (value: number) => void;
}

/** A slider for one number, which can also be typed. */
export function Slider(props: SliderProps) {
  const { label, symbol, unit = "", least, most, step, value, standard, help, disabled = false, marks, track } = props;
  /** Where the user has it; null while it rests. */
  const [held, setHeld] = useState<number | null>(null);
  const open = useRef<number | null>(null);
  /** A key is down: its repeats are one drag. */
  const keyed = useRef(false);
  const latest = useRef(props);
  latest.current = props;
  const shown = held ?? value;

  const drag = (to: number) => {
    open.current = to;
    setHeld(to);
    latest.current.onDrag?.(to);
  };
  const commit = () => {
    const to = open.current;
    if (to !== null) {
      open.current = null;
      setHeld(null);
      latest.current.onCommit(to);
    }
  };
  // What is taken away under the pointer is let go.
  useEffect(
    () => () => {
      if (open.current !== null) {
        latest.current.onCommit(open.current);
      }
    },
    [],
  );

  const place = placeOf(props, shown);
  // A track that is not even goes by places, and its keys by steps of the value.
  const input = props.travel
    ? { min: 0, max: 1, step: "any", value: place }
    : { min: least, max: most, step, value: shown };
  const isStandard = Math.abs(value - standard) < step / 2;
  return (
    <Field
      label={label}
      symbol={symbol}
      help={help}
      onReset={isStandard || disabled ? undefined : (props.onReset ?? (() => props.onCommit(standard)))}
      end={
        <TypedNumber
          {...{ label, unit, least, most, step, disabled, notation: props.notation }}
          value={shown}
          onCommit={(to) => props.onCommit(to)}
        />
      }
    >
      {(description) => (
        <div class="slider">
          <input
            type="range"
            aria-label={label}
            aria-describedby={description}
            aria-valuetext={
              props.inWords?.(shown) ?? props.notation?.write(shown) ?? `${numberText(shown, step)}${unitText(unit)}`
            }
            {...input}
            disabled={disabled}
            data-track={track}
            style={{ "--place": place }}
            onInput={(event) => {
              const to = Number(event.currentTarget.value);
              drag(props.travel ? valueAt(props, to) : to);
            }}
            onChange={() => {
              if (!keyed.current) {
                commit();
              }
            }}
            onKeyDown={(event) => {
              keyed.current = true;
              const steps = props.travel ? stepsOf(event.key) : null;
              if (steps !== null) {
                event.preventDefault();
                drag(onStep((open.current ?? value) + steps * step, least, most, step));
              }
            }}
            onKeyUp={() => {
              keyed.current = false;
              commit();
            }}
            onBlur={() => {
              keyed.current = false;
              commit();
            }}
            onPointerCancel={commit}
          />
          {marks && <div class="slider-marks">{marks}</div>}
        </div>
      )}
    </Field>
  );
}
