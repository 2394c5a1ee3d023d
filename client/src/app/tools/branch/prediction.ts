import { signal } from "@preact/signals";
import { TreeTable } from "../../../scene/table/tree-table";
import type { Command } from "../../../wire/generated";
import type { GhostFrame } from "../../../wire/ghost";
import type { Key } from "../../words/say";
import { TRUNK_STAYS } from "../prune/prune-rule";

/** Steps that can be predicted with the slider. */
export const MOST_STEPS = 30;
/** And those that are before anyone has said how many. */
export const FIRST_STEPS = 10;

export interface PredictionOptions {
  /** The rows with which begins what is cut off at others; none for the trunk (`PR1`). */
  readonly cutsOf: (rows: readonly number[]) => readonly number[];
  /** Asks the server; false while there is none to ask. */
  readonly predict: (rows: number[], steps: number) => boolean;
  readonly submit: (command: Command) => void;
  /** A number that no other operation of this client has. */
  readonly newGesture: () => number;
  /** A ghost has come. */
  readonly show: (table: TreeTable) => void;
  /** It has gone; the tree may be about to become what it was. */
  readonly end: (becoming: TreeTable | null) => void;
  /** Something a person should know. */
  readonly tell: (text: Key) => void;
}

/** What would become of the tree without some branches: a ghost beside it, to be kept or discarded. */
export class Prediction {
  /** The branches that are cut off in it; null while nothing is predicted. */
  readonly rows = signal<readonly number[] | null>(null);
  /** The rows with which what is cut off begins. */
  readonly cuts = signal<readonly number[]>([]);
  /** How far it looks ahead. */
  readonly steps = signal(FIRST_STEPS);
  /** How far the ghost that is shown has grown; null while there is none yet. */
  readonly grown = signal<number | null>(null);
  #options: PredictionOptions;
  #ghost = new TreeTable();
  #shown = false;
  /** The steps of the question that is not yet answered. */
  #asked: number | null = null;

  constructor(options: PredictionOptions) {
    this.#options = options;
  }

  /** Looks at what would become of the tree without these branches. */
  ask(rows: readonly number[]): void {
    const cuts = this.#options.cutsOf(rows);
    if (cuts.length === 0) {
      this.#options.tell(TRUNK_STAYS);
      return;
    }
    // A ghost that is there already stays until the next one comes.
    this.grown.value = null;
    this.rows.value = rows;
    this.cuts.value = cuts;
    this.#asked = null;
    this.#question();
  }

  /** Looks so many steps ahead. */
  look(steps: number): void {
    this.steps.value = Math.min(MOST_STEPS, Math.max(1, Math.round(steps)));
    this.#question();
  }

  /** The server's answer; an empty one means that there is no ghost any more. */
  receive({ changes, epoch, sequence }: GhostFrame): void {
    if (this.rows.peek() === null) {
      return;
    }
    if (changes.length === 0) {
      // Something this client did has ended it; so does a question that is answered anew.
      if (this.#asked === null) {
        this.#end();
      }
      return;
    }
    this.#ghost.clear();
    this.#ghost.apply({ epoch, sequence, catchUp: true, changes });
    this.grown.value = this.#asked ?? this.steps.peek();
    this.#asked = null;
    this.#shown = true;
    this.#options.show(this.#ghost);
    this.#question();
  }

  /** The server could not make the ghost. Whether there was a question it could have been about. */
  refused(): boolean {
    if (this.#asked === null) {
      return false;
    }
    this.#end();
    return true;
  }

  /** Does what the ghost shows: cut and grown in one operation. */
  keep(): void {
    const [rows, grown] = [this.rows.peek(), this.grown.peek()];
    if (rows === null || grown === null) {
      return;
    }
    this.#end(this.#ghost);
    const gesture = this.#options.newGesture();
    this.#options.submit({ kind: "prune", rows: [...rows], gesture });
    this.#options.submit({ kind: "grow", steps: grown, gesture });
  }

  /** Forgets the ghost; the tree is as it was. */
  discard(): void {
    if (this.rows.peek() !== null) {
      this.#end();
      this.#options.predict([], 0);
    }
  }

  /** What was asked will not be answered: the connection is another one, or this client does something else (`PD2`). */
  lost(): void {
    if (this.rows.peek() !== null) {
      this.#end();
    }
  }

  /** Asks for what is wanted now, one question at a time. */
  #question(): void {
    const [rows, steps] = [this.rows.peek(), this.steps.peek()];
    if (rows === null || this.#asked !== null || steps === this.grown.peek()) {
      return;
    }
    if (this.#options.predict([...rows], steps)) {
      this.#asked = steps;
    } else {
      this.#end();
      this.#options.tell("tools.no-connection");
    }
  }

  #end(becoming: TreeTable | null = null): void {
    this.rows.value = null;
    this.cuts.value = [];
    this.grown.value = null;
    this.#asked = null;
    if (this.#shown) {
      this.#shown = false;
      this.#options.end(becoming);
    }
  }
}
