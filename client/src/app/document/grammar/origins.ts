import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import type { GrammarInForce, GrammarOrigins } from "../../../wire/generated";
import { NewestOnly } from "../../requests/newest-only";
import { type Range, ruleRange } from "./text-place";

export interface OriginsPage {
  readonly ask: () => Promise<GrammarOrigins>;
  readonly inForce: ReadonlySignal<GrammarInForce | null>;
  /** Counts the frames of rows that came in. */
  readonly revision: ReadonlySignal<number>;
  readonly failed: (error: unknown) => void;
}

/** Which rule made which wood, while somebody wants to know. */
export class Origins {
  /** Whether somebody does. */
  readonly wanted = signal(false);
  /** The rule that is looked at, by the line it begins on. */
  readonly line = signal<number | null>(null);
  readonly #known = signal<GrammarOrigins | null>(null);
  /** The living rows that the rule which is looked at has made. */
  readonly rows = computed<readonly number[]>(() => {
    const [known, line] = [this.#known.value, this.line.value];
    return known === null || line === null ? [] : rowsOf(known, line);
  });
  /** What was looked at before the server had said which rule made what; it is found when that comes. */
  #later: (() => void) | null = null;
  readonly #stop: () => void;

  constructor({ ask, inForce, revision, failed }: OriginsPage) {
    const newest = new NewestOnly<null, GrammarOrigins>(
      ask,
      (origins) => {
        this.#known.value = origins;
        const later = this.#later;
        this.#later = null;
        later?.();
      },
      failed,
    );
    this.#stop = effect(() => {
      revision.value;
      if (this.wanted.value && inForce.value !== null) {
        newest.ask(null);
      } else {
        this.#known.value = null;
        this.#later = null;
      }
    });
  }

  /** Looks at the rule that made a row, and says on which line it begins, or null where no rule did. */
  look(row: number, found: (line: number | null) => void): void {
    this.#once((known) => {
      const rule = known.rules[known.by[known.rows.indexOf(row)] ?? -1];
      this.line.value = rule?.line ?? null;
      found(this.line.peek());
    });
  }

  /** Looks at the rule that a place in the text belongs to. */
  lookAt(text: string, place: number): void {
    this.#once((known) => {
      this.line.value = lineOf(known.rules, text, place);
    });
  }

  /** Looks now, or when it is known which rule made what: a tap that comes early is not lost. The last one counts. */
  #once(look: (known: GrammarOrigins) => void): void {
    const known = this.#known.peek();
    this.#later = null;
    if (known !== null) {
      look(known);
    } else if (this.wanted.peek()) {
      this.#later = () => this.#once(look);
    }
  }

  /** Where in a text the rule stands that is looked at. */
  range(text: string): Range | null {
    return this.line.value === null ? null : ruleRange(text, this.line.value);
  }

  dispose(): void {
    this.#stop();
  }
}

/** The rows that a rule has made. */
export function rowsOf({ rules, rows, by }: GrammarOrigins, line: number): number[] {
  const numbers = new Set(rules.flatMap((rule, number) => (rule.line === line ? [number] : [])));
  return rows.filter((_, i) => numbers.has(by[i] ?? -1));
}

/** The line on which the rule begins that a place belongs to; null where none does that has made anything. */
export function lineOf(rules: GrammarOrigins["rules"], text: string, place: number): number | null {
  const found = rules.find(({ line }) => {
    const { from, to } = ruleRange(text, line);
    return from <= place && place <= to;
  });
  return found?.line ?? null;
}
