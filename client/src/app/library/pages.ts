import { signal } from "@preact/signals";

/** So many items come at once: some screens full. */
export const PAGE = 48;

/** Some items of a long list, and where the next ones begin, if there are any. */
export interface Page<Item> {
  readonly items: readonly Item[];
  readonly next?: string;
}

/** A long list of the server, as far as someone has looked into it. */
export class Pages<Item> {
  /** The items that are here, in their order; null before the first have come. */
  readonly items = signal<readonly Item[] | null>(null);
  /** What the last asking failed with; null if it did not. */
  readonly failure = signal<unknown>(null);
  /** Whether there are more. */
  readonly more = signal(true);
  #list: (limit: number, after?: string) => Promise<Page<Item>>;
  #keyOf: (item: Item) => unknown;
  #asking = false;
  /** Where the next page begins. */
  #after: string | undefined;

  constructor(list: (limit: number, after?: string) => Promise<Page<Item>>, keyOf: (item: Item) => unknown) {
    this.#list = list;
    this.#keyOf = keyOf;
  }

  /** Brings the next items, unless they are on their way or there are none. */
  async next(): Promise<void> {
    if (this.#asking || !this.more.peek()) {
      return;
    }
    this.#asking = true;
    try {
      const page = await this.#list(PAGE, this.#after);
      // What was changed or removed meanwhile stays so.
      const now = this.items.peek() ?? [];
      const known = new Set(now.map(this.#keyOf));
      this.items.value = [...now, ...page.items.filter((item) => !known.has(this.#keyOf(item)))];
      this.#after = page.next;
      this.more.value = page.next !== undefined;
      this.failure.value = null;
    } catch (error) {
      this.failure.value = error;
    } finally {
      this.#asking = false;
    }
  }

  /** An item has changed, or is gone. */
  replace(key: unknown, item: Item | null): void {
    this.items.value = (this.items.peek() ?? []).flatMap((other) =>
      this.#keyOf(other) === key ? (item ?? []) : [other],
    );
  }

  /** A new one stands before all others. */
  begin(item: Item): void {
    this.items.value = [item, ...(this.items.peek() ?? [])];
  }
}
