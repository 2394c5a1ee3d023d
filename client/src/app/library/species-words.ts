import type { Species } from "../../wire/generated";
import { foundSpecies } from "../document/species/species-choice";

/** Shorter words are in too many names. */
const LEAST_LETTERS = 3;

/**
 * Words as the server is asked for them: it knows species by their short names alone, so where a word is part of a
 * species' name in any language, that is searched as well (`LB7`).
 */
export function inShortNames(words: string, species: readonly Species[]): string {
  return words
    .split(/\s+/)
    .map((word) => {
      const named = word.length < LEAST_LETTERS ? [] : foundSpecies(species, word);
      return [word, ...named.map(({ slug }) => slug).filter((slug) => !slug.includes(word.toLowerCase()))].join("|");
    })
    .join(" ");
}

/** Whether one of the words is part of a species' name in any language. */
export function isNamed(words: string, species: Species): boolean {
  return words.split(/\s+/).some((word) => word !== "" && foundSpecies([species], word).length > 0);
}
