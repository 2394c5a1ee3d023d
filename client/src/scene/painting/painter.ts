import type { Levels } from "./leaf-atlas";
import { type Order, paint } from "./paint";

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

/** Paints beside the page, so that no frame waits for it; where no worker is to be had, on the page after all. */
export class Painter {
  /** Whether the picture is visible yet; before that no picture is painted. */
  begun = false;
  private worker: PaintWorker | null = null;
  private broken = false;
  private current: Job | null = null;
  private waiting: Job[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `painted` is called after each finished picture. */
  constructor(
    private readonly painted: () => void = () => {},
    private readonly start: () => PaintWorker = startWorker,
  ) {}

  /** Orders a picture; the result cancels the order. */
  order(order: Order, done: (painted: Levels[]) => void): () => void {
    const job = { order, done };
    this.waiting.push(job);
    this.next();
    return () => {
      this.waiting = this.waiting.filter((other) => other !== job);
      // The picture that is being painted is finished and then dropped.
      if (this.current === job) this.current = { order, done: () => {} };
    };
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.waiting = [];
    this.current = null;
    this.worker?.terminate();
    this.worker = null;
  }

  private next(): void {
    if (this.current || this.waiting.length === 0) return;
    this.current = this.waiting.shift()!;
    const { order } = this.current;
    if (!this.broken && !this.worker) this.worker = this.started();
    if (this.worker) this.worker.postMessage(order);
    else this.timer = setTimeout(() => this.finish(paint(order)), 0);
  }

  private finish(painted: Levels[]): void {
    const job = this.current;
    this.current = null;
    job?.done(painted);
    this.painted();
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
