/** The part of a worker that is used; tests bring their own. */
export interface WorkerPort<Task, Answer> {
  onmessage: ((event: { readonly data: Answer }) => void) | null;
  onerror: (() => void) | null;
  postMessage(task: Task): void;
  terminate(): void;
}

/** A worker beside the page, started with its first task. Where none is to be had the page has to do the tasks itself. */
export class TaskWorker<Task, Answer> {
  private port: WorkerPort<Task, Answer> | null = null;
  private lost = false;

  /** `answered` hears of each answer; `failed` once the worker has ended by itself, with what it was doing. None comes after that. */
  constructor(
    private readonly start: () => WorkerPort<Task, Answer>,
    private readonly answered: (answer: Answer) => void,
    private readonly failed: () => void,
  ) {}

  /** Hands a task over; false where there is no worker. */
  send(task: Task): boolean {
    this.port ??= this.started();
    this.port?.postMessage(task);
    return this.port !== null;
  }

  /** Ends it, whatever it is doing. Another task has another one started. */
  end(): void {
    this.port?.terminate();
    this.port = null;
  }

  private started(): WorkerPort<Task, Answer> | null {
    if (this.lost) return null;
    try {
      const port = this.start();
      port.onmessage = ({ data }) => this.answered(data);
      port.onerror = () => this.giveUp();
      return port;
    } catch {
      this.lost = true;
      return null;
    }
  }

  private giveUp(): void {
    this.lost = true;
    this.end();
    this.failed();
  }
}
