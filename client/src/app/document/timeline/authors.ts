import { say } from "../../words/say";

/** Hues that are told apart on the strip, light or dark. */
const HUES = [208, 28, 285, 340, 176, 52, 250, 5] as const;

/** The colour of whoever did something; that of the leaves as long as one person does everything. */
export function authorColour(author: number, people: number): string {
  return people < 2 ? "var(--leaf)" : `oklch(62% 0.14 ${HUES[author % HUES.length] ?? HUES[0]})`;
}

/** Names are not asked for: people are told apart by colour and number. */
export function authorName(author: number): string {
  return say("timeline.person", { number: author + 1 });
}
