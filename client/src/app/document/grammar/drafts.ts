import { signal } from "@preact/signals";
import { kept } from "../../page/settings";

/** So many texts are kept at most; the oldest go first. */
const MOST = 8;
const LIST = "espalier.grammar-drafts";

/** What stands in the editor of a session and is not planted, and what the server had while it was written. */
export interface Unplanted {
  readonly session: string;
  readonly text: string;
  readonly agreed: string;
}

export type Store = Pick<Storage, "getItem" | "setItem">;

/**
 * Texts of grammars that somebody typed and that no tree has: those that others took the place of, for all pages of
 * this browser, and the one in the editor, for when this page is loaded again.
 */
export class Drafts {
  /** Those that were put aside, the newest first. */
  readonly aside = signal<readonly string[]>([]);
  readonly #written;

  constructor(
    private readonly list: Store,
    own: Storage,
  ) {
    this.aside.value = this.#read();
    this.#written = kept<Unplanted | null>(own, "grammar-text", null, isUnplanted);
  }

  /** Keeps a text; nothing is kept of an empty one. */
  keep(text: string): void {
    if (text.trim() !== "") {
      this.#write([text, ...this.#read().filter((other) => other !== text)].slice(0, MOST));
    }
  }

  /** Forgets a text, since a tree has it now or nobody wants it. */
  drop(text: string): void {
    if (this.aside.peek().includes(text)) {
      this.#write(this.#read().filter((other) => other !== text));
    }
  }

  /** What stands in the editor; null where a tree has it. */
  stands(unplanted: Unplanted | null): void {
    this.#written.value = unplanted;
  }

  /** What stood in the editor of a session when the page was left; that of another session is put aside. */
  left(session: string): Unplanted | null {
    const left = this.#written.peek();
    if (left !== null && left.session !== session) {
      this.keep(left.text);
      return null;
    }
    return left;
  }

  /** Other pages of this browser may have kept something since. */
  #read(): readonly string[] {
    try {
      const found: unknown = JSON.parse(this.list.getItem(LIST) ?? "[]");
      return Array.isArray(found) && found.every((text) => typeof text === "string") ? found : [];
    } catch {
      return this.aside.peek();
    }
  }

  #write(texts: readonly string[]): void {
    this.aside.value = texts;
    try {
      this.list.setItem(LIST, JSON.stringify(texts));
    } catch {
      // Private windows may forbid storing; the texts then live as long as the page.
    }
  }
}

function isUnplanted(value: unknown): boolean {
  const { session, text, agreed } = (value ?? {}) as Record<string, unknown>;
  return [session, text, agreed].every((part) => typeof part === "string");
}
