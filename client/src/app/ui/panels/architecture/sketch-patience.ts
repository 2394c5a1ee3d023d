import { signal } from "@preact/signals";

/** So many questions in a row without an answer, and something is wrong; the server is asked again in between. */
const LOST = 3;

/**
 * Whether the sketch of the panel has been grown, or given up: the pictures of all species, which take the server seconds,
 * are asked for after it, or the sketch would wait for them.
 */
export const sketchSettled = signal(false);

/** What is known of a sketch that was asked for, by how often in a row there was no answer. */
export function sketchState(grown: boolean, unanswered: number): "grown" | "growing" | "failed" {
  if (unanswered >= LOST) return "failed";
  return grown ? "grown" : "growing";
}
