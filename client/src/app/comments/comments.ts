import { signal } from "@preact/signals";
import type { Pin } from "../../wire/generated";
import type { Conversation } from "./conversation";

/** A step that is looked at in a copy of the session that nobody else sees, for the sake of a comment. */
export interface LookBack {
  readonly session: string;
  readonly thread: number;
  readonly step: number;
  /** Shows the view that the comment has. */
  readonly show: () => void;
}

/** What the server tells of comments on the tree; what is said is read when somebody looks (`CT`). */
export class Comments {
  /** Where threads are pinned now, by their numbers. */
  readonly pins = signal<ReadonlyMap<number, Pin>>(new Map());
  /** Threads that have changed and were not read again. */
  readonly stale = signal<ReadonlySet<number>>(new Set());
  /** The thread that is shown. */
  readonly open = signal<number | null>(null);
  /** What is said, once the code that reads it is there. */
  readonly conversation = signal<Conversation | null>(null);
  /** What the copy of the session that the page is in was opened for; null where it is played. */
  lookBack: LookBack | null = null;

  place(pins: readonly Pin[]): void {
    const all = new Map(this.pins.peek());
    for (const pin of pins) {
      all.set(pin.thread, pin);
    }
    this.pins.value = all;
  }

  change(threads: readonly number[]): void {
    this.stale.value = new Set([...this.stale.peek(), ...threads]);
  }

  /** The page or the session is left. */
  leaving(): void {
    this.conversation.peek()?.leaving();
  }

  /** Another session was opened. */
  clear(): void {
    this.pins.value = new Map();
    this.stale.value = new Set();
    this.open.value = null;
    this.conversation.peek()?.clear();
  }
}
