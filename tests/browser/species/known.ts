import type { RunningServer } from "../src/server";

/** A species, as a server tells it; what only commands need is handed on as it came. */
export interface Species {
  readonly slug: string;
  readonly name: string;
  readonly programme: { readonly age: number };
  readonly appearance: Readonly<Record<string, unknown>>;
}

/** The species with these slugs, or all; a slug that is not there is an error. */
export async function chosen({ address }: RunningServer, slugs: readonly string[]): Promise<readonly Species[]> {
  const all = (await (await fetch(`${address}/api/v1/species`)).json()) as Species[];
  const unknown = slugs.filter((slug) => !all.some((one) => one.slug === slug));
  if (unknown.length > 0) throw new Error(`no such species: ${unknown.join(", ")}`);
  return slugs.length === 0 ? all : all.filter(({ slug }) => slugs.includes(slug));
}
