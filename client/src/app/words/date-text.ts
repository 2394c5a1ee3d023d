import { language } from "./say";

/** A day in the language of the page, from a time as ISO 8601 has it. */
export function dateText(time: string): string {
  return textOf(time, { dateStyle: "medium" });
}

/** The same with the time of day. */
export function momentText(time: string): string {
  return textOf(time, { dateStyle: "medium", timeStyle: "short" });
}

function textOf(time: string, style: Intl.DateTimeFormatOptions): string {
  const date = new Date(time);
  return Number.isNaN(date.valueOf()) ? time : date.toLocaleString(language.value, style);
}
