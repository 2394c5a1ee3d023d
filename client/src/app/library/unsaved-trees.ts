import type { Signal } from "@preact/signals";
import type { SavedState, UnsavedTree } from "./unsaved-tree";

/** So many are remembered: their pictures lie in the small store of the browser. */
const MOST = 24;

export interface UnsavedTreesOptions {
  readonly list: Signal<readonly UnsavedTree[]>;
  readonly saved: Signal<SavedState | null>;
  readonly session: () => string | null;
  /** Living metamers of the tree on the page. */
  readonly metamers: () => number;
  /** A small picture of it. */
  readonly picture: () => Promise<string | undefined>;
}

/** What tells one state of a session's time from another. */
export interface Moment {
  readonly step: number;
  readonly done: number;
  readonly operations: readonly unknown[];
}

/** Whether the tree on the page is saved, and the trees of this device that were left without. */
export class UnsavedTrees {
  #options: UnsavedTreesOptions;
  /** The place in time that the page is at. */
  #mark: string | null = null;
  /** The session that was opened from the library: it is saved as it comes. */
  #opened: string | null = null;

  constructor(options: UnsavedTreesOptions) {
    this.#options = options;
  }

  get list(): Signal<readonly UnsavedTree[]> {
    return this.#options.list;
  }

  /** Whether something has grown on the page that is not in the library. */
  get isUnsaved(): boolean {
    const { session, saved, metamers } = this.#options;
    return session() !== null && metamers() > 0 && saved.peek()?.session !== session();
  }

  /** Another session is opened. */
  clear(): void {
    this.#mark = null;
  }

  /** A session begins as a tree of the library. */
  opened(session: string): void {
    this.#opened = session;
  }

  /** The page is at a moment of the session's time; another one than was saved is not saved. */
  follow({ step, done, operations }: Moment): void {
    const { session, saved } = this.#options;
    this.#mark = `${step} ${done} ${operations.length}`;
    if (this.#opened !== null && this.#opened === session()) {
      this.#opened = null;
      this.saved();
    } else if (saved.peek()?.session === session() && saved.peek()?.mark !== this.#mark) {
      saved.value = null;
    }
  }

  /** The tree was saved as it stands. */
  saved(): void {
    const session = this.#options.session();
    if (session !== null && this.#mark !== null) {
      this.#options.saved.value = { session, mark: this.#mark };
      this.forget(session);
    }
  }

  /** Remembers the tree on the page if it is not saved; true if so. */
  async keep(): Promise<boolean> {
    const { session, metamers, picture, list } = this.#options;
    const name = session();
    if (name === null || !this.isUnsaved) {
      return false;
    }
    const tree = { session: name, metamers: metamers(), left: new Date().toISOString() };
    // A tree without a picture is better than none.
    const thumbnail = await picture().catch(() => undefined);
    const others = list.peek().filter((other) => other.session !== name);
    list.value = [{ ...tree, ...(thumbnail === undefined ? {} : { thumbnail }) }, ...others].slice(0, MOST);
    return true;
  }

  forget(session: string): void {
    const { list } = this.#options;
    list.value = list.peek().filter((other) => other.session !== session);
  }
}
