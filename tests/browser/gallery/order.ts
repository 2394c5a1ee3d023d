import { resolve } from "node:path";
import { parseArgs } from "node:util";
import { FOLDER } from "./catalogue";

/** What is asked for on the command line. */
export interface Order {
  /** Of sketches; none stands for all. */
  readonly names: readonly string[];
  /** Whether small pictures will do. */
  readonly draft: boolean;
  /** Where the pictures go. */
  readonly out: string;
}

/** Reads `[NAME...] [--draft] [--out FOLDER]`; anything else is an error. A folder is looked for from `here`. */
export function readOrder(words: readonly string[], here: string): Order {
  const { values, positionals } = parseArgs({
    args: [...words],
    allowPositionals: true,
    options: { draft: { type: "boolean", default: false }, out: { type: "string" } },
  });
  return {
    names: positionals,
    draft: values.draft,
    out: values.out === undefined ? FOLDER : resolve(here, values.out),
  };
}
