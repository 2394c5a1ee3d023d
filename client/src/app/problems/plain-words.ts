import type { Notice } from "../../wire/generated";
import { RequestFailed, type Trouble } from "../requests/request";
import { type Key, language, say } from "../words/say";

/** The sentence that a user reads about a problem: in their language and without numbers of rows. */
export function plainly({ reason, field = "", allowed = "", cause = "", message }: Trouble): string {
  const [least, most = least] = allowed.match(/-?\d+(\.\d+)?/g) ?? [];
  const isRange = /^-?[\d.]+ to /.test(allowed);
  if (reason === "out-of-range" && (language.value === "en" || !isRange)) {
    return language.value === "en" ? asSentence(message) : say("problems.impossible");
  }
  const part = field.split(".").at(-1);
  for (const key of [`problems.${reason}.${part}`, `problems.${reason}`] as Key[]) {
    const words = say(key, { least: `${least}`, most: `${most}`, allowed, cause });
    if (words !== key) {
      return words;
    }
  }
  return asSentence(message);
}

function asSentence(message: string): string {
  const words = message.replace(/\brow \d+\b/g, "that branch");
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${/[.!?]$/.test(words) ? "" : "."}`;
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
