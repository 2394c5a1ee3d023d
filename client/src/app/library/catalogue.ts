import { signal } from "@preact/signals";
import type { TreeAuthor, TreeCollection, TreeTag } from "../../wire/generated";
import { sentence } from "../problems/plain-words";
import type * as api from "./library-api";

/** A collection, and where it lies among the others. */
export interface Folder extends TreeCollection {
  readonly depth: number;
  /** The names of those it lies in, from the outside. */
  readonly above: readonly string[];
}

export interface CatalogueOptions {
  readonly api: Pick<
    typeof api,
    "listCollections" | "listTags" | "listAuthors" | "addCollection" | "changeCollection" | "deleteCollection"
  >;
  readonly show: (text: string) => void;
}

/** What the trees of the library can be found by: collections, tags and those who saved them. */
export class Catalogue {
  /** Collections, each before those that lie in it; null before they have come. */
  readonly folders = signal<readonly Folder[] | null>(null);
  readonly tags = signal<readonly TreeTag[]>([]);
  readonly authors = signal<readonly TreeAuthor[]>([]);
  #options: CatalogueOptions;

  constructor(options: CatalogueOptions) {
    this.#options = options;
  }

  /** Asks for all of it. */
  async refresh(): Promise<void> {
    const { api } = this.#options;
    await this.#attempt(async () => {
      const [collections, tags, authors] = await Promise.all([
        api.listCollections(),
        api.listTags(),
        api.listAuthors(),
      ]);
      this.folders.value = inOrder(collections);
      this.tags.value = tags;
      this.authors.value = authors;
    });
  }

  /** The collection with this id, if it is there. */
  folder(id: string | null | undefined): Folder | undefined {
    return this.folders.value?.find((one) => one.id === id);
  }

  /** Makes a collection; undefined if that failed. */
  async add(name: string, parent?: string): Promise<TreeCollection | undefined> {
    return this.#change(() => this.#options.api.addCollection({ name, ...(parent === undefined ? {} : { parent }) }));
  }

  async rename(id: string, name: string): Promise<void> {
    await this.#change(() => this.#options.api.changeCollection(id, { name }));
  }

  /** Has it lie in another one, or, where that is empty, in none. */
  async move(id: string, parent: string): Promise<void> {
    await this.#change(() => this.#options.api.changeCollection(id, { parent }));
  }

  /** Deletes one: what lies in it lies in its parent then. True if it is gone. */
  async remove(id: string): Promise<boolean> {
    const gone = await this.#change(async () => {
      await this.#options.api.deleteCollection(id);
      return true;
    });
    return gone ?? false;
  }

  async #change<Result>(work: () => Promise<Result>): Promise<Result | undefined> {
    const result = await this.#attempt(work);
    await this.refresh();
    return result;
  }

  async #attempt<Result>(work: () => Promise<Result>): Promise<Result | undefined> {
    try {
      return await work();
    } catch (error) {
      this.#options.show(sentence(error));
      return undefined;
    }
  }
}

/** Collections as a list that shows which lie in which; those on one level stay in the order they come in. */
export function inOrder(collections: readonly TreeCollection[]): readonly Folder[] {
  const known = new Set(collections.map(({ id }) => id));
  const under = (parent: string | undefined, above: readonly string[]): readonly Folder[] =>
    collections
      .filter((one) => (known.has(one.parent ?? "") ? one.parent : undefined) === parent)
      .flatMap((one) => [{ ...one, depth: above.length, above }, ...under(one.id, [...above, one.name])]);
  return under(undefined, []);
}

/** The collections that one can be moved into: not itself, nor what lies in it. */
export function placesFor(folders: readonly Folder[], id: string): readonly Folder[] {
  const from = folders.findIndex((one) => one.id === id);
  const depth = folders[from]?.depth ?? 0;
  const end = folders.findIndex((one, at) => at > from && one.depth <= depth);
  return folders.filter((_, at) => at < from || (end >= 0 && at >= end));
}

/** Its name after those of the collections it lies in. */
export function pathOf({ above, name }: Folder): string {
  return [...above, name].join(" › ");
}
