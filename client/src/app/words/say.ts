import { signal } from "@preact/signals";
import { FIRST } from "./first";
import { LANGUAGES, type Language } from "./languages";
import type { TABLE } from "./table";

export { LANGUAGES, type Language };

/** The name of a text. */
export type Key = keyof typeof TABLE;
/** A text in every language, in their order, as what stands beside its own code has it. */
export type Text = readonly [english: string, german: string];

const first: Readonly<Record<string, readonly string[]>> = FIRST;
/** Texts of parts that were loaded, by language. */
const learnt = new Map<Language, Readonly<Record<string, string>>>();

/** The language spoken now; what is said with it is said anew when it changes. */
export const language = signal<Language>("en");

/** A text in the present language; `{name}` in it stands for a value of that name. */
export function say(key: Key | Text, values: Readonly<Record<string, string | number>> = {}): string {
  const text = textIn(language.value, key) ?? String(key);
  return text.replace(/\{(\w+)\}/g, (hole, name: string) => String(values[name] ?? hole));
}

/** A text in every language that is loaded, for searches. */
export function inAll(key: Key | Text): string {
  return LANGUAGES.map((language) => textIn(language, key) ?? "").join(" ");
}

/** The names of all texts that are loaded in the present language. */
export function keysSaid(): string[] {
  return [...Object.keys(learnt.get(language.value) ?? {}), ...Object.keys(first)];
}

/** Takes the texts of the parts that are loaded later into use. */
export function learn(language: Language, texts: Readonly<Record<string, string>>): void {
  learnt.set(language, texts);
}

/** Whether those of a language are loaded. */
export function hasLearnt(language: Language): boolean {
  return learnt.has(language);
}

function textIn(language: Language, key: Key | Text): string | undefined {
  const column = LANGUAGES.indexOf(language);
  return typeof key === "string" ? (first[key]?.[column] ?? learnt.get(language)?.[key]) : key[column];
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
