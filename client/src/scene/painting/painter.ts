import type { Levels } from "./leaf-atlas";
import type { Order } from "./paint";

/** The part of a worker that is used; tests bring their own. */
export interface PaintWorker {
  onmessage: ((event: { readonly data: Levels[] }) => void) | null;
  onerror: (() => void) | null;
  postMessage(order: Order): void;
  terminate(): void;
}

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
  private worker: PaintWorker | null = null;
  private broken = false;
  /** Whether nothing can be painted: neither the worker nor what paints on the page could be loaded. */
  lost = false;
  private current: Job | null = null;
  private waiting: Job[] = [];
  /** What was painted on the page for a painter that has been disposed of meanwhile is dropped. */
  private disposed = false;

  /** `painted` is called after each finished picture, with what had been ordered; `failed` once nothing can be painted at all. */
  constructor(
    private readonly painted: (order: Order) => void = () => {},
    private readonly start: () => PaintWorker = startWorker,
    private readonly failed: () => void = () => {},
    private readonly load: () => Promise<Pick<typeof import("./paint"), "paint">> = () => import("./paint"),
  ) {}

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
    this.worker?.terminate();
    this.worker = null;
  }

  private next(): void {
    if (this.lost || this.current || this.waiting.length === 0) return;
    this.current = this.waiting.shift()!;
    const { order } = this.current;
    if (!this.broken && !this.worker) this.worker = this.started();
    if (this.worker) this.worker.postMessage(order);
    else void this.paintHere(order);
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

  private started(): PaintWorker | null {
    try {
      const worker = this.start();
      worker.onmessage = ({ data }) => this.finish(data);
      worker.onerror = () => this.giveUp();
      return worker;
    } catch {
      this.broken = true;
      return null;
    }
  }

  private giveUp(): void {
    this.broken = true;
    this.worker?.terminate();
    this.worker = null;
    if (this.current) this.waiting.unshift(this.current);
    this.current = null;
    this.next();
  }
}

function startWorker(): PaintWorker {
  return new Worker(new URL("./paint-worker.ts", import.meta.url), { type: "module" }) as unknown as PaintWorker;
}
