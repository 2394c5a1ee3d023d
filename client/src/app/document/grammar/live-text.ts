/** Texts that are known at most; older ones count as new when they come again. */
const MOST_KNOWN = 64;

/** What is to be done about a text that the server tells. */
export type Told = "same" | "adopt" | "conflict";

/**
 * A text that one person types while others may set it too. It is theirs and the server's at once; where the server
 * tells another one, that one is taken over unless something of one's own would be lost.
 */
export class LiveText {
  /** What stands in the editor. */
  text = "";
  /** What the server has, as far as it is known here: what was told last, or sent after that. */
  agreed = "";
  /** The text of somebody else that waits for a decision. */
  theirs: string | null = null;
  /** Texts that were in force or sent before: who goes back in time loses nothing. */
  #known: string[] = [];
  /** The text that was told last. */
  #told: string | null = null;
  /** What was sent and has not been told since: it may yet be refused. */
  #unanswered: string | null = null;

  /** Whether something was typed that the server does not have. */
  get isAhead(): boolean {
    return this.text !== this.agreed;
  }

  /** What was sent and has not been told since. */
  get unanswered(): string | null {
    return this.#unanswered;
  }

  /** What a page before this one left: a text that is not planted, and what the server had while it was written. */
  restore(text: string, agreed: string): void {
    this.text = text;
    this.agreed = agreed;
  }

  /** Somebody types here. */
  type(text: string): void {
    this.text = text;
  }

  /** The text is sent. */
  send(): string {
    this.agreed = this.text;
    this.#unanswered = this.text;
    this.theirs = null;
    this.#know(this.text);
    return this.text;
  }

  /** A text that was sent is refused: what stands in the editor is not what the server has. */
  refuse(text: string): void {
    if (this.#unanswered === text) {
      this.#unanswered = null;
      this.agreed = this.#told ?? "";
    }
  }

  /**
   * The server tells a text. `typing` says that a bout of typing is not over, `waiting` that something sent from here
   * is not answered.
   */
  tell(told: string, { typing, waiting }: { readonly typing: boolean; readonly waiting: boolean }): Told {
    const isRepeated = told === this.#told;
    this.#told = told;
    if (told === this.#unanswered) {
      this.#unanswered = null;
    }
    if (told === this.text) {
      this.agreed = told;
      this.theirs = null;
      this.#know(told);
      return "same";
    }
    const isKnown = this.#known.includes(told);
    if (told === this.theirs || told === this.agreed || (isKnown && waiting)) {
      // Nothing new, or an answer to what was sent before the last key.
      return "same";
    }
    if (isRepeated && this.#unanswered !== null) {
      // What was sent after it is refused, or not there yet.
      return "same";
    }
    if (this.isAhead || (typing && !isKnown)) {
      this.theirs = told;
      return "conflict";
    }
    this.#adopt(told);
    return "adopt";
  }

  /** Theirs goes; what was typed here is given back, so that it can still be had. */
  takeTheirs(): string {
    const mine = this.text;
    this.#know(mine);
    this.#adopt(this.theirs ?? this.agreed);
    return mine;
  }

  /** Mine goes: it is to be sent. */
  keepMine(): void {
    if (this.theirs !== null) {
      this.agreed = this.theirs;
      this.#know(this.theirs);
      this.theirs = null;
    }
  }

  /** No text is in force any more, or another session is open. What was typed stays in the editor. */
  forget(): void {
    this.theirs = null;
    this.#known = [];
    this.#told = null;
    this.#unanswered = null;
  }

  #adopt(text: string): void {
    this.text = text;
    this.#unanswered = null;
    this.agreed = text;
    this.theirs = null;
    this.#know(text);
  }

  #know(text: string): void {
    this.#known = [text, ...this.#known.filter((known) => known !== text)].slice(0, MOST_KNOWN);
  }
}
