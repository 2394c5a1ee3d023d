import { hasLearnt, type Language, language, learn } from "./say";

/** One file a language, which `words-plugin.ts` makes of the table. */
const FILES = {
  en: () => import("virtual:later-words/en"),
  de: () => import("virtual:later-words/de"),
} as const satisfies Record<Language, unknown>;

/** Whether any part that needs them has been asked for. */
let needed = false;
let newest: Language = "en";

/** Loads the texts of the parts that are loaded later, in the language spoken now. */
export async function laterWords(): Promise<void> {
  needed = true;
  // The language may change meanwhile.
  while (!hasLearnt(language.peek())) {
    await laterWordsIn(language.peek());
  }
}

/** The same in one language. */
export async function laterWordsIn(wanted: Language): Promise<void> {
  if (!hasLearnt(wanted)) {
    learn(wanted, (await FILES[wanted]()).default);
  }
}

/** Speaks a language from now on: at once, or where the page has such parts already, when their texts are there. */
export async function speak(chosen: Language): Promise<void> {
  newest = chosen;
  if (needed) {
    await laterWordsIn(chosen);
  }
  if (newest === chosen) {
    language.value = chosen;
  }
}
