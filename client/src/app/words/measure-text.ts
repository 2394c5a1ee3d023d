import { language } from "./say";

/** A length in metres as the language spoken now writes it: to the centimetre below one metre, else to the decimetre. */
export function metresText(metres: number): string {
  return unitText(metres, "meter", "short", metres < 1 ? 2 : 1);
}

/** A whole number of years. */
export function yearsText(years: number): string {
  return unitText(years, "year", "long", 0);
}

/** A whole number with its thousands apart. */
export function countText(count: number): string {
  return new Intl.NumberFormat(language.value).format(count);
}

function unitText(value: number, unit: string, unitDisplay: "short" | "long", maximumFractionDigits: number): string {
  return new Intl.NumberFormat(language.value, { style: "unit", unit, unitDisplay, maximumFractionDigits }).format(
    value,
  );
}
