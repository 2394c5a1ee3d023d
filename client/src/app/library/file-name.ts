/** What no file's name may have on one system or another. */
const FORBIDDEN = /[\\/:*?"<>|\p{Cc}]+/gu;

/** A file's name made of a tree's, which may be any text. */
export function fileName(tree: string, ending: string): string {
  const name = tree
    .replace(FORBIDDEN, " ")
    .replace(/\s+/g, " ")
    .replace(/^[\s.]+|[\s.]+$/g, "");
  return `${name === "" ? "tree" : name}.${ending}`;
}
