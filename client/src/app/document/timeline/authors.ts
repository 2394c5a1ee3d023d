import { say } from "../../words/say";

/** Hues that are distinguished on the strip, light or dark. */
const HUES = [208, 28, 285, 340, 176, 52, 250, 5] as const;

/** The colour of an author; that of the leaves as long as there is only one. */
export function authorColour(author: number, people: number): string {
  return people < 2 ? "var(--leaf)" : `oklch(62% 0.14 ${HUES[author % HUES.length] ?? HUES[0]})`;
}

/** People have no names: they are distinguished by colour and number. */
export function authorName(author: number): string {
  return say("timeline.person", { number: author + 1 });
}
