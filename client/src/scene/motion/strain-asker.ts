import type { DrawnObstacle } from "../obstacle-meshes";
import { TaskWorker, type WorkerPort } from "../task-worker";
import { ObstaclePost } from "./obstacle-post";
import { type StrainTask, StrainWork } from "./strain";

/** What is asked; all obstacles that are drawn. */
export interface StrainOrder extends Omit<StrainTask, "obstacles"> {
  readonly obstacles: readonly DrawnObstacle[];
}

export type StrainWorker = WorkerPort<StrainTask, Int32Array>;

/** Asks beside the page which rows would break, one question at a time; where no worker is to be had, on the page after all. */
export class StrainAsker {
  private readonly worker: TaskWorker<StrainTask, Int32Array>;
  private work: StrainWork | null = null;
  private asked: StrainOrder | null = null;
  private next: StrainOrder | null = null;
  private readonly post = new ObstaclePost();

  /** `answered` hears of the last question's answer: what was asked before it is of no use any more. */
  constructor(
    private readonly answered: (rows: Int32Array) => void,
    start: () => StrainWorker = startWorker,
  ) {
    this.worker = new TaskWorker(
      start,
      (rows) => this.finish(rows),
      () => this.again(),
    );
  }

  /** Asks, or has what is asked now follow what is in work. */
  ask(order: StrainOrder): void {
    if (this.asked) {
      this.next = order;
      return;
    }
    this.asked = order;
    const task = this.taskOf(order);
    if (!this.worker.send(task)) this.finish(this.onPage(task));
  }

  /** No answer is waited for any more. */
  forget(): void {
    this.asked = null;
    this.next = null;
    this.worker.end();
    this.lose();
  }

  /** What the worker knew is lost. */
  private again(): void {
    this.lose();
    if (this.asked) this.finish(this.onPage(this.taskOf(this.asked)));
  }

  private lose(): void {
    this.work = null;
    this.post.forget();
  }

  private onPage(task: StrainTask): Int32Array {
    this.work ??= new StrainWork();
    return this.work.broken(task);
  }

  private taskOf({ rows, scale, air, obstacles }: StrainOrder): StrainTask {
    return { rows, scale, air, obstacles: this.post.post(obstacles) };
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
