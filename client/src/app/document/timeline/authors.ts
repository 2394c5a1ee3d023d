import type { TimelineOperation, TimelinePart } from "../../../wire/generated";
import type { Together } from "../../together/together";
import { say } from "../../words/say";

/** Hues that are distinguished on the strip and in the tree, light or dark. */
const HUES = [208, 28, 285, 340, 176, 52, 250, 5, 95, 310] as const;

/** The colour of an author on the line of time; that of the leaves as long as there is only one. */
export function authorColour(author: number, people: number): string {
  return people < 2 ? "var(--leaf)" : personColour(author);
}

/** The colour of a person, by their number from 1. */
export function personColour(person: number): string {
  return `oklch(62% 0.14 ${HUES[(person - 1) % HUES.length] ?? HUES[0]})`;
}

/** Who did an operation, and whether they have taken it back: several where they drew at once. */
export function partsOf({ author, away, parts }: TimelineOperation): readonly TimelinePart[] {
  return parts?.length ? parts : [{ author, away: away ?? false }];
}

/** Who did an operation, each once; away if all of theirs is. */
export function distinctParts(operation: TimelineOperation): TimelinePart[] {
  const all = partsOf(operation);
  const authors = [...new Set(all.map(({ author }) => author))];
  return authors.map((author) => ({
    author,
    away: all.every((part) => part.author !== author || part.away === true),
  }));
}

/** What an author is called: by name if they are here and have one, or if a replay knows it, else by number. */
export function authorName(author: number, { people, authors }: Pick<Together, "people" | "authors">): string {
  const known = [...(people.value?.people ?? []), ...authors.value];
  return known.find(({ person }) => person === author)?.name ?? say("timeline.person", { number: author });
}
