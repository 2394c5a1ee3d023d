import { signal } from "@preact/signals";
import { isReplaced, reload, reloadOnce, serverAnswers } from "../page/replaced";
import { laterWords } from "../words/later-words";

/** Why a part is not there: it did not come, or the server has another build of the page, which has other files. */
export type PartFailure = "lost" | "replaced";

/** What a part needs of the page; tests bring their own. */
export interface PartPage {
  readonly isReplaced: () => Promise<boolean>;
  readonly serverAnswers: () => Promise<boolean>;
  readonly reload: () => void;
  /** The same, unless it was done a moment ago. */
  readonly reloadOnce: () => void;
}

/** The styles of everything that is loaded later. */
export function laterStyles(): Promise<unknown> {
  return import("./styles/parts");
}

function laterWordsAndStyles(): Promise<unknown> {
  return Promise.all([laterWords(), laterStyles()]);
}

/** A part of the page that is loaded when it is first needed, with its texts and styles, or before that while the page is idle. */
export class Part<Content> {
  readonly content = signal<Content | null>(null);
  /** Why it is not there; null while it is loaded. */
  readonly failure = signal<PartFailure | null>(null);
  #loading: Promise<void> | null = null;

  constructor(
    private readonly fetch: () => Promise<Content>,
    private readonly beside: () => Promise<unknown> = laterWordsAndStyles,
    private readonly page: PartPage = { isReplaced, serverAnswers, reload, reloadOnce },
  ) {}

  /** Loads it, once; after a failure once more. */
  load(): Promise<void> {
    this.#loading ??= this.#load();
    return this.#loading;
  }

  /** The same because someone needs it now: where only a reload of the page can bring it, the page is reloaded. */
  async open(): Promise<void> {
    await this.load();
    if (this.failure.peek() === "lost" && (await this.page.isReplaced())) {
      this.failure.value = "replaced";
      this.page.reloadOnce();
    }
  }

  /** Tries once more. Browsers remember a script that did not come: then only a new page brings it. */
  async again(): Promise<void> {
    await this.load();
    if (this.failure.peek() !== null && (await this.page.serverAnswers())) {
      this.page.reload();
    }
  }

  async #load(): Promise<void> {
    this.failure.value = null;
    try {
      const [content] = await Promise.all([this.fetch(), this.beside()]);
      this.content.value = content;
    } catch (error) {
      console.warn("A part of the page could not be loaded:", error);
      this.#loading = null;
      this.failure.value = "lost";
    }
  }
}
