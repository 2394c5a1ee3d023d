import { language } from "./say";

/** How many digits after the point a step can change. */
export function digitsOf(step: number): number {
  return Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
}

/** A number as the language spoken now writes it, with no more digits than a step shows. */
export function numberText(value: number, step: number): string {
  const digits = digitsOf(step);
  const text = new Intl.NumberFormat(language.value, {
    minimumFractionDigits: digits,
    maximumFractionDigits: digits,
    useGrouping: false,
  }).format(value);
  // What rounds to nothing has no sign.
  return (Number(value.toFixed(digits)) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** A unit as it follows a number: after a space, but for the sign of degrees. */
export function unitText(unit: string): string {
  return unit === "" || unit === "°" ? unit : ` ${unit}`;
}

/** What a person typed as a number, in either language; null if it is none. */
export function typedNumber(text: string): number | null {
  const plain = /^\s*([-−+]?)\s*(\d*)[.,]?(\d*)/.exec(text);
  const [, sign = "", whole = "", part = ""] = plain ?? [];
  if (whole === "" && part === "") {
    return null;
  }
  const value = Number(`${whole === "" ? "0" : whole}.${part === "" ? "0" : part}`);
  return sign === "-" || sign === "−" ? -value : value;
}

/** The value nearest to one that a control can have: within its range, on one of its steps. */
export function onStep(value: number, least: number, most: number, step: number): number {
  const stepped = least + Math.round((value - least) / step) * step;
  // Steps add up with an error that nobody wants to read.
  return Math.min(most, Math.max(least, Number(stepped.toFixed(digitsOf(step)))));
}
