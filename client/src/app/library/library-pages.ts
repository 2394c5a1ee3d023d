import { signal } from "@preact/signals";
import type { SavedTree } from "../../wire/generated";
import type { Behind } from "./library-api";

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
  #list: (limit: number, behind?: Behind) => Promise<SavedTree[]>;
  #asking = false;

  constructor(list: (limit: number, behind?: Behind) => Promise<SavedTree[]>) {
    this.#list = list;
  }

  /** Brings the next trees, unless they are on their way or there are none. */
  async next(): Promise<void> {
    if (this.#asking || !this.more.peek()) {
      return;
    }
    this.#asking = true;
    const here = this.trees.peek() ?? [];
    try {
      const page = await this.#list(PAGE, here[here.length - 1]);
      // What was renamed or deleted meanwhile stays so.
      const now = this.trees.peek() ?? [];
      const known = new Set(now.map(({ id }) => id));
      this.trees.value = [...now, ...page.filter(({ id }) => !known.has(id))];
      this.more.value = page.length === PAGE;
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
