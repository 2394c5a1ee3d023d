import { TaskWorker, type WorkerPort } from "../task-worker";
import type { Levels } from "./leaf-atlas";
import type { Order } from "./paint";

export type PaintWorker = WorkerPort<Order, Levels[]>;

interface Job {
  readonly order: Order;
  readonly done: (painted: Levels[]) => void;
}

/**
 * Paints beside the page, so that no frame waits for it and the page need not load what paints; where no worker is to be
 * had, on the page after all. Coarse pictures come before whole ones.
 */
export class Painter {
  /** Whether the picture is visible yet; before that no picture is painted. */
  begun = false;
  private readonly worker: TaskWorker<Order, Levels[]>;
  /** Whether nothing can be painted: neither the worker nor what paints on the page could be loaded. */
  lost = false;
  private current: Job | null = null;
  private waiting: Job[] = [];
  /** What was painted on the page for a painter that has been disposed of meanwhile is dropped. */
  private disposed = false;

  /** `painted` is called after each finished picture, with what had been ordered; `failed` once nothing can be painted at all. */
  constructor(
    private readonly painted: (order: Order) => void = () => {},
    start: () => PaintWorker = startWorker,
    private readonly failed: () => void = () => {},
    private readonly load: () => Promise<Pick<typeof import("./paint"), "paint">> = () => import("./paint"),
  ) {
    this.worker = new TaskWorker(
      start,
      (painted) => this.finish(painted),
      () => this.again(),
    );
  }

  /** Orders a picture; the result cancels the order. */
  order(order: Order, done: (painted: Levels[]) => void): () => void {
    const job = { order, done };
    const before = order.coarse ? this.waiting.findIndex((other) => !other.order.coarse) : -1;
    this.waiting.splice(before < 0 ? this.waiting.length : before, 0, job);
    this.next();
    return () => {
      this.waiting = this.waiting.filter((other) => other !== job);
      // The picture that is being painted is finished and then dropped.
      if (this.current === job) this.current = { order, done: () => {} };
    };
  }

  dispose(): void {
    this.disposed = true;
    this.waiting = [];
    this.current = null;
    this.worker.end();
  }

  private next(): void {
    if (this.lost || this.current || this.waiting.length === 0) return;
    this.current = this.waiting.shift()!;
    const { order } = this.current;
    if (!this.worker.send(order)) void this.paintHere(order);
  }

  private async paintHere(order: Order): Promise<void> {
    const loaded = await this.load().catch(() => null);
    if (this.disposed) return;
    if (loaded) {
      this.finish(loaded.paint(order));
      return;
    }
    this.lost = true;
    this.current = null;
    this.waiting = [];
    this.failed();
  }

  private finish(painted: Levels[]): void {
    const job = this.current;
    this.current = null;
    job?.done(painted);
    if (job) this.painted(job.order);
    this.next();
  }

  /** What was in work is painted on the page. */
  private again(): void {
    if (this.current) this.waiting.unshift(this.current);
    this.current = null;
    this.next();
  }
}

function startWorker(): PaintWorker {
  return new Worker(new URL("./paint-worker.ts", import.meta.url), { type: "module" }) as unknown as PaintWorker;
}
