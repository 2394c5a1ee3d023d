/** So many trees a job grows at most (`JB1`). */
export const MOST_TREES = 1000;
export const LAST_SEED = 0xffff_ffff;

/** How far trees are grown: to the age of what they are like, so many steps more, or on until they have so many metamers. */
export const UNTIL = ["age", "steps", "metamers"] as const;
export type Until = (typeof UNTIL)[number];

/** What trees are to be like: a species, or a saved tree. */
export interface Pattern {
  /** The short name of a species, or the identifier of a saved tree. */
  readonly template: string;
  readonly name: string;
  /** Where its picture is. */
  readonly picture: string | undefined;
}

/** Which trees somebody wants. */
export interface Wish {
  readonly trees: number;
  /** Each tree has a seed of its own, one after the other. */
  readonly first: number;
  readonly until: Until;
  readonly steps: number;
  readonly metamers: number;
}

export const FIRST_WISH: Wish = { trees: 10, first: 1, until: "age", steps: 10, metamers: 50_000 };

/** What `POST /api/v1/grow` takes. */
export interface Order {
  readonly template: string;
  readonly seeds: string;
  readonly steps?: number;
  readonly metamers?: number;
  readonly format: string;
  readonly options: Readonly<Record<string, string | true>>;
}

/** The seed of the last tree. */
export function lastSeed({ trees, first }: Pick<Wish, "trees" | "first">): number {
  return first + trees - 1;
}

/** The highest seed that so many trees can begin with. */
export function mostFirst(trees: number): number {
  return LAST_SEED - trees + 1;
}

/** A wish as the server takes it; `options` are those of a download (`optionsOf`). */
export function orderOf(
  { template }: Pick<Pattern, "template">,
  wish: Wish,
  format: string,
  options: ReadonlyMap<string, string>,
): Order {
  const { until, steps, metamers, first } = wish;
  return {
    template,
    seeds: `${first}-${lastSeed(wish)}`,
    ...(until === "steps" ? { steps } : {}),
    ...(until === "metamers" ? { metamers } : {}),
    format,
    options: Object.fromEntries([...options].map(([name, value]) => [name, value === "true" ? true : value])),
  };
}
