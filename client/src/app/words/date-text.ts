import { language } from "./say";

/** A day in the language of the page, from a time as ISO 8601 has it. */
export function dateText(time: string): string {
  const date = new Date(time);
  return Number.isNaN(date.valueOf()) ? time : date.toLocaleDateString(language.value, { dateStyle: "medium" });
}
