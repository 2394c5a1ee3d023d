import { computed, type Signal, signal } from "@preact/signals";
import type { Clock } from "../../page/clock";
import { RequestFailed } from "../../requests/request";
import type * as api from "./job-api";
import type { Job } from "./job-api";
import type { Order } from "./order";

/** How often it is asked how far jobs are. */
const EVERY = 1000;
/** The same where the server was silent. */
const AWAY = 5000;
/** The device remembers so many orders. */
const KEPT_ORDERS = 100;

/** What was ordered from this device, which the server does not tell. */
export interface Ordered {
  /** The name of the job. */
  readonly id: string;
  /** What its trees are like. */
  readonly name: string;
  /** How the names of its files end. */
  readonly ending: string;
}

export interface JobsOptions {
  readonly api: Pick<typeof api, "orderTrees" | "findJob" | "giveUpJob" | "listJobs">;
  /** Kept on the device, the last one first. */
  readonly ordered: Signal<readonly Ordered[]>;
  readonly clock: Clock;
  readonly newKey: () => string;
}

/** Whether its trees are still grown. */
export function isActive({ state }: Pick<Job, "state">): boolean {
  return state === "waiting" || state === "growing";
}

/** The jobs of whoever is here. */
export class Jobs {
  /** Those ordered last first; null until they are known. */
  readonly list = signal<readonly Job[] | null>(null);
  /** What the last question failed with; null if it did not. */
  readonly failure = signal<unknown>(null);
  /** Whether an order is on its way. */
  readonly ordering = signal(false);
  readonly active = computed(() => (this.list.value ?? []).filter(isActive));
  readonly ordered: Signal<readonly Ordered[]>;
  #options: JobsOptions;
  #followers = new Set<(ended: Job) => void>();
  #wait: (() => void) | null = null;
  #asking = false;
  /** An order that may have arrived although its answer did not: the same again is done once. */
  #unanswered: { readonly body: string; readonly key: string } | null = null;

  constructor(options: JobsOptions) {
    this.#options = options;
    this.ordered = options.ordered;
  }

  /** What is known of a job's order here. */
  orderOf(id: string): Ordered | undefined {
    return this.ordered.value.find((order) => order.id === id);
  }

  /** Keeps the list up to date until what this gives is called; `ended` is told of each job that ends meanwhile. */
  follow(ended: (job: Job) => void = () => {}): () => void {
    // One of its own, for the same function may follow twice.
    const follower = (job: Job) => ended(job);
    this.#followers.add(follower);
    if (this.list.peek() === null) {
      void this.look();
    } else {
      this.#later();
    }
    return () => {
      this.#followers.delete(follower);
      if (this.#followers.size === 0) {
        this.#wait?.();
        this.#wait = null;
      }
    };
  }

  /** Asks for all jobs. */
  async look(): Promise<void> {
    await this.#ask(async () => {
      const jobs = await this.#options.api.listJobs();
      const known = new Set(jobs.map(({ id }) => id));
      this.ordered.value = this.ordered.peek().filter(({ id }) => known.has(id));
      this.list.value = this.#sorted(jobs);
    });
  }

  /** Orders trees; what is refused is thrown. */
  async order(order: Order, name: string): Promise<Job | null> {
    if (this.ordering.peek()) {
      return null;
    }
    this.ordering.value = true;
    const body = JSON.stringify(order);
    const key = this.#unanswered?.body === body ? this.#unanswered.key : this.#options.newKey();
    this.#unanswered = { body, key };
    try {
      const job = await this.#options.api.orderTrees(order, key);
      this.#unanswered = null;
      this.ordered.value = [
        { id: job.id, name, ending: order.format },
        ...this.ordered.peek().filter(({ id }) => id !== job.id),
      ].slice(0, KEPT_ORDERS);
      this.list.value = this.#sorted([job, ...(this.list.peek() ?? []).filter(({ id }) => id !== job.id)]);
      this.#later();
      return job;
    } catch (error) {
      if (!mayHaveArrived(error)) {
        this.#unanswered = null;
      }
      throw error;
    } finally {
      this.ordering.value = false;
    }
  }

  /** Ends a job, and takes its files away. */
  async giveUp(id: string): Promise<void> {
    await this.#options.api.giveUpJob(id);
    this.#take(id, null);
  }

  #later(): void {
    const isNeeded = this.list.peek() === null || this.active.peek().length > 0;
    if (this.#wait === null && !this.#asking && this.#followers.size > 0 && isNeeded) {
      this.#wait = this.#options.clock.after(this.failure.peek() === null ? EVERY : AWAY, () => {
        this.#wait = null;
        void (this.list.peek() === null ? this.look() : this.#refresh());
      });
    }
  }

  /** Asks how far those are that are still grown. */
  async #refresh(): Promise<void> {
    await this.#ask(async () => {
      for (const { id } of this.active.peek()) {
        this.#take(id, await this.#options.api.findJob(id));
      }
    });
  }

  async #ask(work: () => Promise<void>): Promise<void> {
    if (this.#asking) {
      return;
    }
    this.#asking = true;
    try {
      await work();
      this.failure.value = null;
    } catch (error) {
      this.failure.value = error;
    }
    this.#asking = false;
    this.#later();
  }

  /** A job is as far as that, or gone. */
  #take(id: string, job: Job | null): void {
    const before = this.list.peek()?.find((other) => other.id === id);
    // It was given up while the question was on its way.
    if (before === undefined) {
      return;
    }
    this.list.value = (this.list.peek() ?? []).flatMap((other) => (other.id === id ? (job ?? []) : [other]));
    if (job === null) {
      this.ordered.value = this.ordered.peek().filter((order) => order.id !== id);
    } else if (isActive(before) && !isActive(job)) {
      for (const ended of this.#followers) {
        ended(job);
      }
    }
  }

  /** Those ordered here last first, then those that were ordered elsewhere. */
  #sorted(jobs: readonly Job[]): readonly Job[] {
    const places = new Map(this.ordered.peek().map(({ id }, place) => [id, place]));
    const placeOf = ({ id }: Job) => places.get(id) ?? Number.POSITIVE_INFINITY;
    return [...jobs].sort((a, b) => (placeOf(a) === placeOf(b) ? 0 : placeOf(a) - placeOf(b)));
  }
}

/** Whether the server may do what was asked although its answer was no success (`IK3`). */
function mayHaveArrived(error: unknown): boolean {
  return (
    error instanceof RequestFailed &&
    (error.status === 0 || error.status >= 500 || error.problem.reason === "key-under-way")
  );
}
