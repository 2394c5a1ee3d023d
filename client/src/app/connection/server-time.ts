import type { Clock } from "../page/clock";

/** Of so many answers, the one that came back soonest counts. */
const KEPT = 8;
/** Milliseconds between two questions, for the first few and from then on. */
const SOON = 1000;
const LATER = 20_000;
/** What answers differ by beyond what their ways explain, in milliseconds, means that the server has begun anew. */
const RESTARTED = 1000;
/** Numbers of these questions, apart from those by which the connection finds out whether the server lives. */
const FIRST_NONCE = 2 ** 30;

interface Answer {
  /** What the server's clock is ahead of the own one. */
  readonly offset: number;
  /** How long question and answer took. */
  readonly way: number;
}

/** The server's time, as all pages of a session share it (`WD2`). It is asked for only while somebody reads it. */
export class ServerTime {
  #answers: Answer[] = [];
  #asked: { readonly nonce: number; readonly at: number } | null = null;
  #nonce = FIRST_NONCE;
  #due = Number.NEGATIVE_INFINITY;

  /** `ask` sends a ping with a number, and says whether there was a server to take it. */
  constructor(
    private readonly ask: (nonce: number) => boolean,
    private readonly clock: Pick<Clock, "now">,
  ) {}

  /** Milliseconds on the server's clock; on the own one until the server has answered. */
  read(): number {
    const now = this.clock.now();
    if (now >= this.#due) {
      this.#nonce += 1;
      this.#asked = this.ask(this.#nonce) ? { nonce: this.#nonce, at: now } : null;
      this.#due = now + (this.#asked && this.#answers.length >= KEPT ? LATER : SOON);
    }
    return now + (this.#best?.offset ?? 0);
  }

  /** A pong has come. Those that the connection asked for itself do not count. */
  heard(nonce: number, at: number): void {
    const asked = this.#asked;
    if (asked?.nonce !== nonce || !Number.isFinite(at)) return;
    this.#asked = null;
    const now = this.clock.now();
    const answer = { offset: at - (asked.at + now) / 2, way: now - asked.at };
    const best = this.#best;
    if (best && Math.abs(best.offset - answer.offset) > RESTARTED + (best.way + answer.way) / 2) this.#answers = [];
    this.#answers = [...this.#answers, answer].slice(-KEPT);
  }

  get #best(): Answer | undefined {
    return [...this.#answers].sort((a, b) => a.way - b.way)[0];
  }
}
