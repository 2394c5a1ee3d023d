import type { DrawnObstacle } from "../obstacle-meshes";
import { TaskWorker, type WorkerPort } from "../task-worker";
import { type JointsMade, type JointTask, JointWork } from "./joint-work";
import { ObstaclePost } from "./obstacle-post";

/** What is ordered; all obstacles that are drawn. */
export interface JointOrder extends Omit<JointTask, "obstacles"> {
  readonly obstacles: readonly DrawnObstacle[];
}

export type JointWorker = WorkerPort<JointTask, JointsMade>;

/** Has joints made beside the page, one order at a time; where no worker is to be had, on the page after all. */
export class JointMaker {
  private readonly worker: TaskWorker<JointTask, JointsMade>;
  private work: JointWork | null = null;
  private order: JointOrder | null = null;
  private readonly post = new ObstaclePost();

  /** `made` hears of each answer. */
  constructor(
    private readonly made: (made: JointsMade, order: JointOrder) => void,
    start: () => JointWorker = startWorker,
  ) {
    this.worker = new TaskWorker(
      start,
      (made) => this.finish(made),
      () => this.again(),
    );
  }

  /** Whether an order is in work. */
  get busy(): boolean {
    return this.order !== null;
  }

  /** Orders joints; only while none are in work. */
  make(order: JointOrder): void {
    this.order = order;
    const task = this.taskOf(order);
    if (!this.worker.send(task)) this.finish(this.onPage(task));
  }

  dispose(): void {
    this.order = null;
    this.worker.end();
  }

  /** What the worker knew is lost: an order without rows of its own is answered by nothing. */
  private again(): void {
    this.post.forget();
    if (this.order) this.finish(this.onPage(this.taskOf(this.order)));
  }

  private onPage(task: JointTask): JointsMade {
    this.work ??= new JointWork();
    return this.work.make(task);
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
