import type { Species } from "../../wire/generated";
import { say } from "../words/say";
import { inShortNames } from "./species-words";

/** The orders in which trees are listed, the usual one first. */
export const SORTS = ["newest", "oldest", "name", "largest", "smallest"] as const;
export type Sort = (typeof SORTS)[number];

/** Sizes of trees, from so many metamers to so many. */
export const SIZES = {
  any: [undefined, undefined],
  small: [undefined, 999],
  medium: [1000, 9999],
  large: [10_000, 99_999],
  huge: [100_000, undefined],
} as const satisfies Record<string, readonly [least: number | undefined, most: number | undefined]>;
export type Size = keyof typeof SIZES;

/** Which trees of the library somebody wants to see; all conditions hold at once (`LB7`). */
export interface Wanted {
  readonly words: string;
  readonly tags: readonly string[];
  /** A collection; empty for trees that lie in none, null for all trees. */
  readonly collection: string | null;
  readonly favourite: boolean;
  /** The short name of a species, an author's name; empty for any. */
  readonly species: string;
  readonly author: string;
  /** Only those that this device saved last. */
  readonly mine: boolean;
  readonly size: Size;
  /** The first and the last day of saving, as fields for dates have them; empty for any. */
  readonly from: string;
  readonly to: string;
  readonly sort: Sort;
}

export const ANYTHING: Wanted = {
  words: "",
  tags: [],
  collection: null,
  favourite: false,
  species: "",
  author: "",
  mine: false,
  size: "any",
  from: "",
  to: "",
  sort: "newest",
};

/** Whether something read from the store says what is wanted. */
export function isWanted(value: unknown): boolean {
  if (typeof value !== "object" || value === null) {
    return false;
  }
  const wanted = value as Partial<Wanted>;
  return (
    [wanted.words, wanted.species, wanted.author, wanted.from, wanted.to].every((text) => typeof text === "string") &&
    Array.isArray(wanted.tags) &&
    wanted.tags.every((tag) => typeof tag === "string") &&
    (wanted.collection === null || typeof wanted.collection === "string") &&
    typeof wanted.favourite === "boolean" &&
    typeof wanted.mine === "boolean" &&
    Object.hasOwn(SIZES, wanted.size ?? "") &&
    SORTS.some((sort) => sort === wanted.sort)
  );
}

/** The same in the words of the server; words may also name some of these species. */
export function asked(wanted: Wanted, species: readonly Species[] = []) {
  const [least, most] = SIZES[wanted.size];
  return {
    q: inShortNames(wanted.words.trim(), species) || undefined,
    tags: wanted.tags.join(",") || undefined,
    collection: wanted.collection ?? undefined,
    favourite: wanted.favourite || undefined,
    species: wanted.species || undefined,
    author: wanted.author || undefined,
    mine: wanted.mine || undefined,
    min_metamers: least,
    max_metamers: most,
    saved_from: midnight(wanted.from, 0),
    saved_before: midnight(wanted.to, 1),
    sort: wanted.sort,
  };
}

/** One of the conditions that hold. */
export interface Condition {
  readonly text: string;
  /** What is wanted without it. */
  readonly without: Wanted;
}

/** What narrows the list, but for the collection that is looked into. */
export function conditions(wanted: Wanted, speciesName: (slug: string) => string): readonly Condition[] {
  const { words, tags, favourite, species, author, mine, size, from, to } = wanted;
  const found: (Condition | false)[] = [
    words.trim() !== "" && {
      text: say("finding.is.words", { words: words.trim() }),
      without: { ...wanted, words: "" },
    },
    ...tags.map((tag) => ({
      text: say("finding.is.tag", { tag }),
      without: { ...wanted, tags: tags.filter((other) => other !== tag) },
    })),
    favourite && { text: say("finding.favourites"), without: { ...wanted, favourite: false } },
    species !== "" && { text: speciesName(species), without: { ...wanted, species: "" } },
    author !== "" && { text: say("finding.is.author", { author }), without: { ...wanted, author: "" } },
    mine && { text: say("finding.person.mine"), without: { ...wanted, mine: false } },
    size !== "any" && { text: say(`finding.size.${size}`), without: { ...wanted, size: "any" } },
    from !== "" && { text: say("finding.is.from", { date: from }), without: { ...wanted, from: "" } },
    to !== "" && { text: say("finding.is.to", { date: to }), without: { ...wanted, to: "" } },
  ];
  return found.filter((one) => one !== false);
}

/** The same place and order without any condition. */
export function cleared({ collection, sort }: Wanted): Wanted {
  return { ...ANYTHING, collection, sort };
}

/** When a day begins here, or so many days later; none for what is no day. */
function midnight(day: string, later: number): string | undefined {
  const [year = Number.NaN, month = 1, date = 1] = day.split("-").map(Number);
  const time = new Date(year, month - 1, date + later);
  if (day === "" || Number.isNaN(time.valueOf())) {
    return undefined;
  }
  // The server takes years of four digits from 1970 on, and a year that is being typed may be any.
  return new Date(Math.min(Math.max(time.valueOf(), 0), Date.UTC(9999, 0))).toISOString();
}
