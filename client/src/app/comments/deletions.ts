import { type ReadonlySignal, signal } from "@preact/signals";
import type { Thread } from "../../wire/generated";
import type { Clock } from "../page/clock";

/** A comment that is to go. */
export interface Deletion {
  readonly tree: string;
  readonly thread: number;
  readonly comment: number;
  /** What the page says of it. */
  readonly said: string;
}

export interface DeletionsOptions {
  /** How long a comment can be brought back, in milliseconds. */
  readonly within: number;
  readonly clock: Clock;
  /** Deletes it for everyone; what goes wrong is said there. */
  readonly send: (deletion: Deletion) => Promise<void>;
}

/** Comments that this page no longer shows and the server still has, which cannot bring one back (`CT5`). */
export class Deletions {
  #all = signal<readonly Deletion[]>([]);
  #cancels = new Map<Deletion, () => void>();
  #options: DeletionsOptions;

  constructor(options: DeletionsOptions) {
    this.#options = options;
  }

  get all(): ReadonlySignal<readonly Deletion[]> {
    return this.#all;
  }

  /** Shows a comment no longer; it is deleted once nobody has brought it back. False where it was to go already. */
  begin(deletion: Deletion): boolean {
    const { clock, within } = this.#options;
    const { tree, thread, comment } = deletion;
    if (this.#all.peek().some((one) => one.tree === tree && one.thread === thread && one.comment === comment)) {
      return false;
    }
    this.#all.value = [...this.#all.peek(), deletion];
    this.#cancels.set(
      deletion,
      clock.after(within, () => void this.settle(deletion)),
    );
    return true;
  }

  /** Shows it again, unless the server was told already. */
  takeBack(deletion: Deletion): void {
    if (this.#isOpen(deletion)) {
      this.#forget(deletion);
    }
  }

  /** Deletes it now. */
  async settle(deletion: Deletion): Promise<void> {
    if (this.#isOpen(deletion)) {
      await this.#options.send(deletion);
      this.#forget(deletion);
    }
  }

  /** Deletes now whatever can still be brought back: whoever could do that may not come back. */
  settleAll(): void {
    for (const deletion of [...this.#cancels.keys()]) {
      void this.settle(deletion);
    }
  }

  /** Whether it can still be brought back, which is asked once. */
  #isOpen(deletion: Deletion): boolean {
    this.#cancels.get(deletion)?.();
    return this.#cancels.delete(deletion);
  }

  #forget(deletion: Deletion): void {
    this.#all.value = this.#all.peek().filter((one) => one !== deletion);
  }
}

/** Threads of a tree as they are without comments that are to go; one goes with its last comment. */
export function without(
  threads: ReadonlyMap<number, Thread>,
  tree: string | null,
  deletions: readonly Deletion[],
): ReadonlyMap<number, Thread> {
  const left = new Map(threads);
  for (const deletion of deletions.filter((one) => one.tree === tree)) {
    const thread = left.get(deletion.thread);
    const comments = thread?.comments.filter(({ comment }) => comment !== deletion.comment) ?? [];
    if (thread && comments.length > 0) {
      left.set(thread.thread, { ...thread, comments });
    } else {
      left.delete(deletion.thread);
    }
  }
  return left;
}
