import type { DrawnObstacle } from "../obstacle-meshes";
import { type JointsMade, type JointTask, JointWork } from "./joint-work";
import { ObstaclePost } from "./obstacle-post";

/** What is ordered; all obstacles that are drawn. */
export interface JointOrder extends Omit<JointTask, "obstacles"> {
  readonly obstacles: readonly DrawnObstacle[];
}

/** The part of a worker that is used; tests bring their own. */
export interface JointWorker {
  onmessage: ((event: { readonly data: JointsMade }) => void) | null;
  onerror: (() => void) | null;
  postMessage(task: JointTask): void;
  terminate(): void;
}

/** Has joints made beside the page, one order at a time; where no worker is to be had, on the page after all. */
export class JointMaker {
  private worker: JointWorker | null = null;
  private work: JointWork | null = null;
  private order: JointOrder | null = null;
  private readonly post = new ObstaclePost();

  /** `made` hears of each answer. */
  constructor(
    private readonly made: (made: JointsMade, order: JointOrder) => void,
    private readonly start: () => JointWorker = startWorker,
  ) {}

  /** Whether an order is in work. */
  get busy(): boolean {
    return this.order !== null;
  }

  /** Orders joints; only while none are in work. */
  make(order: JointOrder): void {
    this.order = order;
    this.worker ??= this.started();
    if (this.worker) this.worker.postMessage(this.taskOf(order));
    else this.finish(this.onPage(order));
  }

  dispose(): void {
    this.order = null;
    this.worker?.terminate();
    this.worker = null;
  }

  private started(): JointWorker | null {
    if (this.work) return null;
    try {
      const worker = this.start();
      worker.onmessage = ({ data }) => this.finish(data);
      worker.onerror = () => this.giveUp(worker);
      return worker;
    } catch {
      return null;
    }
  }

  private giveUp(worker: JointWorker): void {
    worker.terminate();
    this.worker = null;
    this.work = new JointWork();
    this.post.forget();
    // What the worker knew is lost: an order without rows of its own is answered by nothing.
    if (this.order) this.finish(this.onPage(this.order));
  }

  private onPage(order: JointOrder): JointsMade {
    this.work ??= new JointWork();
    return this.work.make(this.taskOf(order));
  }

  private taskOf({ grown, along, obstacles }: JointOrder): JointTask {
    return { grown, along, obstacles: this.post.post(obstacles) };
  }

  private finish(made: JointsMade): void {
    const { order } = this;
    this.order = null;
    if (order) this.made(made, order);
  }
}

function startWorker(): JointWorker {
  return new Worker(new URL("./joint-worker.ts", import.meta.url), { type: "module" }) as unknown as JointWorker;
}
