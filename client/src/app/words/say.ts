import { signal } from "@preact/signals";
import { TABLE } from "./table";

/** Languages the interface speaks, in the order of the table's columns. */
export const LANGUAGES = ["en", "de"] as const;
export type Language = (typeof LANGUAGES)[number];

/** The name of a text. */
export type Key = keyof typeof TABLE;

/** The language spoken now; what is said with it is said anew when it changes. */
export const language = signal<Language>("en");

/** A text in the present language; `{name}` in it stands for a value of that name. */
export function say(key: Key, values: Readonly<Record<string, string | number>> = {}): string {
  const text: string = TABLE[key][LANGUAGES.indexOf(language.value)] ?? TABLE[key][0];
  return text.replace(/\{(\w+)\}/g, (hole, name: string) => String(values[name] ?? hole));
}

/** A text in every language, for searches. */
export function inAll(key: Key): string {
  return TABLE[key].join(" ");
}

/** The language among ours that a person's browser asks for first. */
export function preferredLanguage(asked: readonly string[]): Language {
  for (const tag of asked) {
    const found = LANGUAGES.find((language) => tag.toLowerCase().split("-")[0] === language);
    if (found) {
      return found;
    }
  }
  return "en";
}
