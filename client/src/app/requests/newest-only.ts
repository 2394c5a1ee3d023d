/**
 * Asks one question at a time. What is asked meanwhile waits, and only the newest of it: answers keep up with a user
 * who is faster than they are.
 */
export class NewestOnly<Question, Answer> {
  #ask: (question: Question) => Promise<Answer>;
  #answered: (answer: Answer) => void;
  #failed: (error: unknown) => void;
  #asking = false;
  #waiting: { readonly question: Question } | null = null;
  #stopped = false;

  constructor(
    ask: (question: Question) => Promise<Answer>,
    answered: (answer: Answer) => void,
    failed: (error: unknown) => void,
  ) {
    this.#ask = ask;
    this.#answered = answered;
    this.#failed = failed;
  }

  ask(question: Question): void {
    this.#waiting = { question };
    if (!this.#asking) {
      void this.#work();
    }
  }

  /** Asks nothing more, and minds no answer. */
  stop(): void {
    this.#stopped = true;
    this.#waiting = null;
  }

  async #work(): Promise<void> {
    this.#asking = true;
    while (this.#waiting !== null) {
      const { question } = this.#waiting;
      this.#waiting = null;
      try {
        const answer = await this.#ask(question);
        if (!this.#stopped) {
          this.#answered(answer);
        }
      } catch (error) {
        if (!this.#stopped) {
          this.#failed(error);
        }
      }
    }
    this.#asking = false;
  }
}
