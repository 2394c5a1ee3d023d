import type { Command, Problem } from "../wire/generated";

/** Commands about wood, which the server names by its rows and a person does not. */
const ABOUT_WOOD: ReadonlySet<Command["kind"] | undefined> = new Set([
  "turn_branch",
  "graft",
  "prune",
  "set_width",
  "bend_begin",
]);

/** What a person is told about a problem: no numbers of rows, and a sentence. */
export function plainly({ code, message }: Problem, command?: Command): string {
  if (code === "not_found" && ABOUT_WOOD.has(command?.kind)) {
    return "That branch is gone: someone has just cut it, or the tree has shed it.";
  }
  const words = message.replace(/\brow \d+\b/g, "that branch");
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;
}
