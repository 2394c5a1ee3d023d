import type { Problem } from "../wire/generated";

/** Fields that name wood by its rows, which a person does not. */
const WOOD = /^(row|onto|base|touches)/;

/** What a person is told about a problem: no numbers of rows, and a sentence. */
export function plainly({ code, field, message }: Problem): string {
  if (code === "not_found" && WOOD.test(field ?? "")) {
    return "That branch is gone: someone has just cut it, or the tree has shed it.";
  }
  const words = message.replace(/\brow \d+\b/g, "that branch");
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;
}
