import { computed, signal } from "@preact/signals";
import type { LinkRole, MadeLink, NewLink, TreeLink } from "../../../wire/generated";
import type { Clock } from "../../page/clock";
import { RequestFailed } from "../../requests/request";
import type * as api from "./link-api";

/** How often it is asked whether somebody has come by the link that was just made. */
const EVERY = 3000;

export interface TreeLinksOptions {
  readonly tree: string;
  readonly api: Pick<typeof api, "listLinks" | "makeLink" | "changeLink" | "revokeLink">;
  readonly clock: Clock;
  /** A link was not made or not revoked. */
  readonly failed: (error: unknown) => void;
}

/** A link that was just made, whose address is known here alone. */
export interface FreshLink extends MadeLink {
  readonly asked: NewLink;
}

/** The links that let people in for one tree. */
export class TreeLinks {
  /** Newest first; null until they are known. */
  readonly list = signal<readonly TreeLink[] | null>(null);
  /** Why they are not known; null where nothing is wrong. */
  readonly failure = signal<unknown>(null);
  readonly fresh = signal<FreshLink | null>(null);
  /** Whether a link is being made. */
  readonly making = signal(false);
  /** Whether somebody has come by the fresh link. */
  readonly came = computed(() => this.list.value?.find(({ id }) => id === this.fresh.value?.id)?.used ?? false);
  #options: TreeLinksOptions;
  /** Counts the questions: only the newest answer is taken. */
  #asked = 0;
  /** Changes, one after the other. */
  #changes: Promise<void> = Promise.resolve();

  constructor(options: TreeLinksOptions) {
    this.#options = options;
  }

  /** Asks for the links, and again and again while somebody may come by the fresh one; what it gives ends that. */
  follow(): () => void {
    let stop = () => {};
    const round = () => {
      stop = this.#options.clock.after(EVERY, () => {
        if (this.fresh.peek() !== null && !this.came.peek()) {
          void this.look();
        }
        round();
      });
    };
    void this.look();
    round();
    return () => stop();
  }

  /** Asks which links there are; where that fails, what was known stays. */
  async look(): Promise<void> {
    const turn = ++this.#asked;
    this.failure.value = null;
    try {
      const list = await this.#options.api.listLinks(this.#options.tree);
      if (turn === this.#asked) {
        this.list.value = list;
      }
    } catch (error) {
      if (turn === this.#asked && this.list.peek() === null) {
        this.failure.value = error;
      }
    }
  }

  async make(asked: NewLink): Promise<void> {
    if (this.making.peek()) {
      return;
    }
    this.making.value = true;
    try {
      this.fresh.value = { ...(await this.#options.api.makeLink(this.#options.tree, asked)), asked };
    } catch (error) {
      this.#options.failed(error);
    }
    this.making.value = false;
    await this.look();
  }

  /** Whoever came by a link, or comes, may do that from now on; what was chosen last is sent last. */
  change(id: string, role: LinkRole): Promise<void> {
    this.#changes = this.#changes.then(() => this.#change(id, role));
    return this.#changes;
  }

  async #change(id: string, role: LinkRole): Promise<void> {
    try {
      const changed = await this.#options.api.changeLink(this.#options.tree, id, role);
      // What was asked before may be answered with what was.
      this.#asked += 1;
      this.list.value = this.list.peek()?.map((link) => (link.id === id ? changed : link)) ?? null;
    } catch (error) {
      this.#options.failed(error);
    }
    await this.look();
  }

  /** One that is revoked already, or has ended, is no trouble. */
  async revoke(id: string): Promise<void> {
    try {
      await this.#options.api.revokeLink(this.#options.tree, id);
    } catch (error) {
      if (!(error instanceof RequestFailed && error.status === 404)) {
        this.#options.failed(error);
        return;
      }
    }
    if (this.fresh.peek()?.id === id) {
      this.fresh.value = null;
    }
    this.list.value = this.list.peek()?.filter((link) => link.id !== id) ?? null;
    await this.look();
  }
}
