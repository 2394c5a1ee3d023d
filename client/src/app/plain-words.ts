import type { Problem } from "../wire/generated";
import { type Key, language, say } from "./words";

/** Fields that name wood by its rows, which a person does not. */
const WOOD = /^(row|onto|base|touches)/;

/** What the server says in English, and the same among our words; `limit` is a number in it. */
const KNOWN: readonly (readonly [RegExp, Key])[] = [
  [/nothing to undo/, "problems.nothing-to-undo"],
  [/nothing to redo/, "problems.nothing-to-redo"],
  [/nothing to ungrow/, "problems.nothing-to-ungrow"],
  [/stands in so little light/, "problems.no-dim-branch"],
  [/foot of a trunk, which cannot be turned/, "problems.trunk-foot"],
  [/metamers, its budget is/, "problems.full"],
  [/the scene has (?<limit>\d+) obstacles/, "problems.obstacles"],
  [/too many people/i, "problems.people"],
];

/** What a person is told about a problem: in their language where we know it, no numbers of rows, and a sentence. */
export function plainly({ code, field, allowed, message }: Problem): string {
  if (code === "not_found" && WOOD.test(field ?? "")) {
    return say("problems.branch-gone");
  }
  for (const [pattern, key] of KNOWN) {
    const match = pattern.exec(message);
    if (match) {
      return say(key, match.groups);
    }
  }
  if (code === "out_of_range" && language.value !== "en") {
    return allowed === undefined ? say("problems.out-of-range") : say("problems.out-of-range.allowed", { allowed });
  }
  const words = message.replace(/\brow \d+\b/g, "that branch");
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;
}
