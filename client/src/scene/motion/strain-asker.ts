import { brokenBy, type StrainOrder } from "./strain";

/** The part of a worker that is used; tests bring their own. */
export interface StrainWorker {
  onmessage: ((event: { readonly data: Int32Array }) => void) | null;
  onerror: (() => void) | null;
  postMessage(order: StrainOrder): void;
  terminate(): void;
}

/** Asks beside the page which rows would break, one question at a time; where no worker is to be had, on the page after all. */
export class StrainAsker {
  private worker: StrainWorker | null = null;
  private onPage = false;
  private asked: StrainOrder | null = null;
  private next: StrainOrder | null = null;

  /** `answered` hears of the last question's answer: what was asked before it is of no use any more. */
  constructor(
    private readonly answered: (rows: Int32Array) => void,
    private readonly start: () => StrainWorker = startWorker,
  ) {}

  /** Asks, or has what is asked now follow what is in work. */
  ask(order: StrainOrder): void {
    if (this.asked) {
      this.next = order;
      return;
    }
    this.asked = order;
    this.worker ??= this.started();
    if (this.worker) this.worker.postMessage(order);
    else this.finish(brokenBy(order));
  }

  /** No answer is waited for any more. */
  forget(): void {
    this.asked = null;
    this.next = null;
    this.worker?.terminate();
    this.worker = null;
  }

  private started(): StrainWorker | null {
    if (this.onPage) return null;
    try {
      const worker = this.start();
      worker.onmessage = ({ data }) => this.finish(data);
      worker.onerror = () => this.giveUp();
      return worker;
    } catch {
      this.onPage = true;
      return null;
    }
  }

  private giveUp(): void {
    const { asked } = this;
    this.worker?.terminate();
    this.worker = null;
    this.onPage = true;
    if (asked) this.finish(brokenBy(asked));
  }

  private finish(rows: Int32Array): void {
    const { next } = this;
    this.asked = null;
    this.next = null;
    if (next) this.ask(next);
    else this.answered(rows);
  }
}

function startWorker(): StrainWorker {
  return new Worker(new URL("./strain-worker.ts", import.meta.url), { type: "module" }) as unknown as StrainWorker;
}
