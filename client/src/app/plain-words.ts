import type { Problem } from "../wire/generated";
import { RequestFailed } from "./library-api";
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
  [/foot of a trunk, which cannot be moved/, "problems.trunk-moved"],
  [/belongs to a trunk, and nothing branches off/, "problems.trunk-cut"],
  [/is being bent/, "problems.being-bent"],
  [/very branch that begins/, "problems.own-branch"],
  [/leave the world/, "problems.world"],
  [/nothing can grow into this/, "problems.outline"],
  [/(?<limit>\d+) may be; remove some first/, "problems.widths"],
  [/places of wood that was moved/, "problems.places"],
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

/** What to tell a person about an error. */
export function sentence(error: unknown): string {
  if (error instanceof RequestFailed) {
    return plainly(error.problem);
  }
  return error instanceof Error ? error.message : String(error);
}
