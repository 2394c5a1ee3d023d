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
  /** Whether some are on their way. */
  readonly asking = signal(false);
  #list: (limit: number, after?: string) => Promise<Page<Item>>;
  #keyOf: (item: Item) => unknown;
  /** Where the next page begins. */
  #after: string | undefined;
  /** Counts the lists: answers about one that is no longer asked for are not minded. */
  #turn = 0;
  /** Whether what is here is of the list before. */
  #isOld = false;

  constructor(list: (limit: number, after?: string) => Promise<Page<Item>>, keyOf: (item: Item) => unknown) {
    this.#list = list;
    this.#keyOf = keyOf;
  }

  /** Brings the next items, unless they are on their way or there are none. */
  async next(): Promise<void> {
    if (this.asking.peek() || !this.more.peek()) {
      return;
    }
    const turn = this.#turn;
    this.asking.value = true;
    try {
      const page = await this.#list(PAGE, this.#after);
      if (turn === this.#turn) {
        this.#take(page);
      }
    } catch (error) {
      if (turn === this.#turn) {
        this.failure.value = error;
      }
    }
    if (turn === this.#turn) {
      this.asking.value = false;
    }
  }

  /** Begins anew, for something else is listed now; what is here stays until that comes. */
  async anew(): Promise<void> {
    this.#turn += 1;
    this.#isOld = true;
    this.#after = undefined;
    this.more.value = true;
    this.asking.value = false;
    await this.next();
  }

  /** An item has changed, or is gone. */
  replace(key: unknown, item: Item | null): void {
    this.items.value = (this.items.peek() ?? []).flatMap((other) =>
      this.#keyOf(other) === key ? (item ?? []) : [other],
    );
  }

  /** A new one stands before all others. */
  begin(item: Item): void {
    const others = (this.items.peek() ?? []).filter((other) => this.#keyOf(other) !== this.#keyOf(item));
    this.items.value = [item, ...others];
  }

  #take(page: Page<Item>): void {
    // What was changed or removed meanwhile stays so.
    const now = this.#isOld ? [] : (this.items.peek() ?? []);
    this.#isOld = false;
    const known = new Set(now.map(this.#keyOf));
    this.items.value = [...now, ...page.items.filter((item) => !known.has(this.#keyOf(item)))];
    this.#after = page.next;
    this.more.value = page.next !== undefined;
    this.failure.value = null;
  }
}
