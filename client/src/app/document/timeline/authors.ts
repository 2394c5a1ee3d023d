import { say } from "../../words/say";

/** Hues that are distinguished on the strip, light or dark. */
const HUES = [208, 28, 285, 340, 176, 52, 250, 5, 95, 310] as const;

/** The colour of an author; that of the leaves as long as there is only one. */
export function authorColour(author: number, people: number): string {
  return people < 2 ? "var(--leaf)" : colour(author);
}

/** The colour of somebody who is here, by their number from 1. */
export function personColour(person: number): string {
  return colour(person - 1);
}

function colour(number: number): string {
  return `oklch(62% 0.14 ${HUES[number % HUES.length] ?? HUES[0]})`;
}

/** People have no names: they are distinguished by colour and number. */
export function authorName(author: number): string {
  return say("timeline.person", { number: author + 1 });
}
