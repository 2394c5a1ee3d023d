import { join } from "node:path";
import { type Plugin, runnerImport } from "vite";
import { LANGUAGES, type Language } from "./src/app/words/languages.ts";

const PREFIX = "virtual:later-words/";
const TABLE = join(import.meta.dirname, "src/app/words/later.ts");

/** Makes one file a language of the texts that a page loads later: a text stands beside its translation only in the sources. */
export function wordsByLanguage(): Plugin {
  return {
    name: "espalier-words-by-language",
    resolveId: (id) => (id.startsWith(PREFIX) ? `\0${id}` : null),
    async load(id) {
      const column = LANGUAGES.indexOf(id.slice(PREFIX.length + 1) as Language);
      if (!id.startsWith(`\0${PREFIX}`) || column < 0) {
        return null;
      }
      const { module, dependencies } = await runnerImport<typeof import("./src/app/words/later.ts")>(TABLE, {
        configFile: false,
        logLevel: "warn",
      });
      for (const file of [TABLE, ...dependencies]) {
        this.addWatchFile(file);
      }
      const texts = Object.fromEntries(Object.entries(module.LATER).map(([key, texts]) => [key, texts[column]]));
      return `export default ${JSON.stringify(texts)};`;
    },
  };
}
