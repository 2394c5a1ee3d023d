import { useEffect, useRef, useState } from "preact/hooks";
import { say } from "../../words/say";
import { Field } from "./field";
import { Typed } from "./typed-number";

/** Red, green and blue in sRGB, each from 0 to 255. */
export type Colour = [number, number, number];

export interface Swatch {
  readonly colour: Readonly<Colour>;
  readonly label: string;
}

interface ColourFieldProps {
  readonly label: string;
  readonly value: Readonly<Colour>;
  readonly swatches: readonly Swatch[];
  /** What reset puts it back to. */
  readonly standard: Readonly<Colour>;
  /** What it does, in one sentence. */
  readonly help: string;
  readonly onDrag?: (value: Colour) => void;
  readonly onCommit: (value: Colour) => void;
}

/** A colour: one of some that suit, or any. */
export function ColourField({ label, value, swatches, standard, help, onDrag, onCommit }: ColourFieldProps) {
  const [held, setHeld] = useState<Colour | null>(null);
  const shown = held ?? value;
  const input = useRef<HTMLInputElement>(null);
  const latest = useRef(onCommit);
  latest.current = onCommit;
  // Preact has one name for both events of a colour input; only the native one tells when the user lets go.
  useEffect(() => {
    const element = input.current;
    const commit = () => {
      setHeld(null);
      latest.current(colourOf(element?.value ?? ""));
    };
    element?.addEventListener("change", commit);
    return () => element?.removeEventListener("change", commit);
  }, []);
  const any = !swatches.some(({ colour }) => same(colour, shown));
  return (
    <Field
      label={label}
      help={help}
      onReset={same(standard, value) ? undefined : () => onCommit([...standard])}
      end={<TypedColour label={label} value={shown} onCommit={onCommit} />}
    >
      {(description) => (
        <fieldset class="colours" aria-label={label} aria-describedby={description}>
          {swatches.map((swatch) => (
            <button
              type="button"
              class="colour-dot"
              key={swatch.label}
              aria-label={swatch.label}
              title={swatch.label}
              aria-pressed={same(swatch.colour, shown)}
              style={{ "--colour": hexOf(swatch.colour) }}
              onClick={() => onCommit([...swatch.colour])}
            />
          ))}
          <label class="any-colour" data-chosen={any} title={say("controls.any-colour")}>
            <input
              ref={input}
              type="color"
              aria-label={say("controls.any-colour-of", { name: label })}
              value={hexOf(shown)}
              onInput={(event) => {
                const colour = colourOf(event.currentTarget.value);
                setHeld(colour);
                onDrag?.(colour);
              }}
            />
            <span class="colour-wheel" aria-hidden="true" style={{ "--colour": any ? hexOf(shown) : "transparent" }} />
          </label>
        </fieldset>
      )}
    </Field>
  );
}

interface TypedColourProps {
  readonly label: string;
  readonly value: Readonly<Colour>;
  readonly onCommit: (value: Colour) => void;
}

/** A colour by its six figures, typed over when it is touched. */
function TypedColour({ label, value, onCommit }: TypedColourProps) {
  return (
    <Typed
      label={label}
      text={hexOf(value)}
      width={7}
      onTyped={(typed) => {
        const hex = /^#?([0-9a-f]{6})$/i.exec(typed.trim())?.[1];
        const colour: Colour = hex === undefined ? [...value] : colourOf(`#${hex}`);
        if (!same(colour, value)) {
          onCommit(colour);
        }
      }}
    />
  );
}

/** A colour as `#rrggbb`. */
export function hexOf(colour: Readonly<Colour>): string {
  return `#${colour
    .map((part) =>
      Math.min(255, Math.max(0, Math.round(part)))
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

/** What `#rrggbb` means; black where it means nothing. */
export function colourOf(hex: string): Colour {
  const value = Number.parseInt(/^#([0-9a-f]{6})$/i.exec(hex)?.[1] ?? "0", 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}

function same(a: Readonly<Colour>, b: Readonly<Colour>): boolean {
  return a[0] === b[0] && a[1] === b[1] && a[2] === b[2];
}
