import type { Appearance, Parameters, Programme, Species } from "../../../wire/generated";
import { language } from "../../words/say";
import { SPECIES } from "../../words/species";
import { alike } from "../draft";
import { DEFAULTS } from "../growth/growth-parameters";
import type { ProgrammeInForce } from "../growth/programme-control";

/** A species that the parameters in force come from. */
export interface Kin {
  readonly species: Species;
  /** Whether something is no longer as it was picked. */
  readonly changed: boolean;
}

/** So many of a species' parameters may differ, and it is still that species, changed. */
const MOST_CHANGES = 12;

/** The species that a programme is of, if it says so and the server knows it. */
export function kinByProgramme(
  species: readonly Species[],
  { programme, byHand }: ProgrammeInForce,
  looks: Appearance | null,
): Kin | null {
  const one = species.find(({ slug }) => slug === programme.species);
  if (one === undefined) {
    return null;
  }
  const looksAlike = looks === null || looksLike(one, looks);
  return { species: one, changed: byHand.length > 0 || !looksAlike || !alike(programme, one.programme) };
}

/** The parameters that are a species' own when its tree is left alone. */
export const parametersOf = ({ parameters }: Programme): Parameters => ({ ...DEFAULTS, ...parameters });

/**
 * The species that parameters come from: the one they differ from in the fewest places, if those are few and fewer
 * than from what a session begins with. So it is known after an undo, on another tablet, and on another day. Of those
 * that grow alike it is the one that looks so, else the one picked last.
 */
export function kinOf(
  species: readonly Species[],
  parameters: Parameters,
  looks: Appearance | null,
  picked?: string,
): Kin | null {
  const most = Math.min(MOST_CHANGES, changes(DEFAULTS, parameters) - 1);
  const ranked = species
    .map((one) => {
      const differing = changes(parametersOf(one.programme), parameters);
      const looksAlike = looks === null || looksLike(one, looks);
      // Looks count less than any parameter, the last pick less than looks.
      const rank = differing + (looksAlike ? 0 : 0.5) + (one.slug === picked ? 0 : 0.25);
      return { one, differing, looksAlike, rank };
    })
    .filter(({ differing }) => differing <= most)
    .sort((a, b) => a.rank - b.rank);
  const nearest = ranked[0];
  return nearest ? { species: nearest.one, changed: nearest.differing > 0 || !nearest.looksAlike } : null;
}

function changes(one: Parameters, other: Parameters): number {
  const values = new Map<string, unknown>(Object.entries(other));
  return Object.entries(one).filter(([name, value]) => !alike(value, values.get(name))).length;
}

function looksLike({ appearance }: Species, looks: Appearance): boolean {
  return (["leaves", "flowers", "fruits", "bark"] as const).every((section) =>
    alike(appearance[section], looks[section]),
  );
}

/** A species' name in the present language; one that came with a newer server has only its own. */
export function speciesName({ slug, name }: Species): string {
  return (language.value === "de" && german(slug)?.[0]) || name;
}

/** What distinguishes a species from others, in the present language. */
export function speciesSentence({ slug, sentence }: Species): string {
  return (language.value === "de" && german(slug)?.[1]) || sentence;
}

/** The species whose name contains all the words, in whichever language. */
export function foundSpecies(species: readonly Species[], words: string): readonly Species[] {
  const wanted = plain(words).split(/\s+/).filter(Boolean);
  return species.filter((one) => {
    const { slug, name, botanical } = one;
    const text = plain([slug, name, botanical, german(slug)?.[0]].join(" "));
    return wanted.every((word) => text.includes(word));
  });
}

/** Small letters without signs above them, which are rarely typed into a search; ö may be typed o or oe. */
function plain(text: string): string {
  return text
    .toLowerCase()
    .replace(/ß/g, "ss")
    .normalize("NFD")
    .replace(/\p{M}/gu, "")
    .replace(/([aou])e/g, "$1");
}

function german(slug: string): readonly [name: string, sentence: string] | undefined {
  return Object.hasOwn(SPECIES, slug) ? SPECIES[slug as keyof typeof SPECIES] : undefined;
}
