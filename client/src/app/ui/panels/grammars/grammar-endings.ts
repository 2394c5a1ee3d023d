/** How the names of grammars' files end: ours, cpfg's and L-Py's. */
export const ENDINGS = [".lsys", ".l", ".lpy", ".v"] as const;

/** Whether a file's name says that it holds a grammar. */
export function isGrammarFile({ name }: Pick<File, "name">): boolean {
  return ENDINGS.some((ending) => name.toLowerCase().endsWith(ending));
}
