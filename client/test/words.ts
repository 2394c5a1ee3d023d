import { LATER } from "../src/app/words/later";
import { LANGUAGES, learn } from "../src/app/words/say";

// Tests say every text in every language at once; a page loads some of them later.
for (const [column, language] of LANGUAGES.entries()) {
  learn(language, Object.fromEntries(Object.entries(LATER).map(([key, texts]) => [key, texts[column]!])));
}
