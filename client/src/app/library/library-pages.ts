import { signal } from "@preact/signals";
import type { SavedTree, TreePage } from "../../wire/generated";

/** So many trees come at once: some screens full. */
export const PAGE = 48;

/** The library, as far as someone has looked into it. */
export class LibraryPages {
  /** The trees that are here, newest first; null before the first have come. */
  readonly trees = signal<readonly SavedTree[] | null>(null);
  /** What the last asking failed with; null if it did not. */
  readonly failure = signal<unknown>(null);
  /** Whether there are more. */
  readonly more = signal(true);
  #list: (limit: number, after?: string) => Promise<TreePage>;
  #asking = false;
  /** Where the next page begins. */
  #after: string | undefined;

  constructor(list: (limit: number, after?: string) => Promise<TreePage>) {
    this.#list = list;
  }

  /** Brings the next trees, unless they are on their way or there are none. */
  async next(): Promise<void> {
    if (this.#asking || !this.more.peek()) {
      return;
    }
    this.#asking = true;
    try {
      const page = await this.#list(PAGE, this.#after);
      // What was renamed or deleted meanwhile stays so.
      const now = this.trees.peek() ?? [];
      const known = new Set(now.map(({ id }) => id));
      this.trees.value = [...now, ...page.trees.filter(({ id }) => !known.has(id))];
      this.#after = page.next;
      this.more.value = page.next !== undefined;
      this.failure.value = null;
    } catch (error) {
      this.failure.value = error;
    } finally {
      this.#asking = false;
    }
  }

  /** A tree has another name, or is gone. */
  replace(id: string, tree: SavedTree | null): void {
    this.trees.value = (this.trees.peek() ?? []).flatMap((other) => (other.id !== id ? other : (tree ?? [])));
  }
}
