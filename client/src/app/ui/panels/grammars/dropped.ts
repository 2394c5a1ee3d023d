import { grammarsOf } from "../../../document/grammar/grammars-of";
import type { Studio } from "../../../studio";
import { openGrammar } from "./grammar-file";

/** Opens a grammar that was dropped on the page. */
export function takeGrammar(studio: Studio, file: File): Promise<void> {
  return openGrammar(studio, grammarsOf(studio).editing, file);
}
