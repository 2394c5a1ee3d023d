import type { Notice, Problem } from "../../wire/generated";
import { RequestFailed } from "../requests/request";
import { type Key, language, say } from "../words/say";
import { ALLOWED, REFUSALS } from "./refusal-table";

/** Fields that name wood by its rows, which a person does not. */
const WOOD = /^(row|onto|base|touches)/;

/** The sentence that a user reads about a problem: in their language and without numbers of rows. */
export function plainly({ code, field, allowed, message }: Problem): string {
  if (code === "not_found" && WOOD.test(field ?? "")) {
    return say("problems.branch-gone");
  }
  const known = matched(REFUSALS, message);
  if (known !== null) {
    return known;
  }
  if (code === "malformed") {
    return say("problems.page");
  }
  if (code === "out_of_range" && language.value !== "en") {
    const words = matched(ALLOWED, allowed ?? "");
    return words === null ? say("problems.out-of-range") : say("problems.out-of-range.allowed", { allowed: words });
  }
  const words = message.replace(/\brow \d+\b/g, "that branch");
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;
}

/** The words of the first entry that a text matches; null if none does. */
function matched(table: readonly (readonly [RegExp, Key])[], text: string): string | null {
  for (const [pattern, key] of table) {
    const match = pattern.exec(text);
    if (match) {
      return say(key, match.groups);
    }
  }
  return null;
}

/** The sentence that a user reads about an error. */
export function sentence(error: unknown): string {
  if (error instanceof RequestFailed) {
    return plainly(error.problem);
  }
  return error instanceof Error ? error.message : String(error);
}

/** The sentence that a user reads about how the session was opened. */
export function noticed(notice: Notice): string {
  return notice.kind === "damaged" ? say("problems.damaged", { entry: notice.entry }) : say("problems.regrown");
}
