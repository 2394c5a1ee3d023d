import { type ChildProcess, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** The program under test. */
export const program = process.env.ESPALIER_PROGRAM ?? join(import.meta.dirname, "../../../target/debug/espalier");
/** Only keeps a test from hanging. */
const GUARD = 60_000;

/** What tests ask of a server wherever it runs. */
export abstract class RunningServer {
  abstract readonly address: string;

  /** A session of its own for a test; returns its address. */
  async newSession(seed: number): Promise<string> {
    const answer = await fetch(`${this.address}/api/v1/sessions`, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify({ seed }),
    });
    const { session } = (await answer.json()) as { session: string };
    return `${this.address}/s/${session}`;
  }
}

/** One that was started elsewhere. */
export class ServerAt extends RunningServer {
  constructor(readonly address: string) {
    super();
  }
}

/** One that is started here, with a database of its own. */
export class Server extends RunningServer {
  port = 0;
  /** Where it keeps what it keeps. */
  readonly folder = mkdtempSync(join(tmpdir(), "espalier-browser-"));
  /** All that it has printed since it was started. */
  printed = "";
  #child: ChildProcess | null = null;

  /** `options` are more ones of the program's. */
  constructor(readonly options: readonly string[] = []) {
    super();
  }

  /** The file it keeps everything in. */
  get database(): string {
    return join(this.folder, "trees.db");
  }

  get address(): string {
    return `http://127.0.0.1:${this.port}`;
  }

  /** Starts it, on the same port as before if there was one. */
  async start(): Promise<void> {
    const where = ["--host", "127.0.0.1", "--port", String(this.port), "--database", this.database];
    const child = spawn(program, ["serve", ...where, ...this.options], { stdio: ["ignore", "pipe", "pipe"] });
    this.#child = child;
    this.printed = "";
    this.port = await new Promise<number>((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`the server printed no address:\n${this.printed}`)), GUARD);
      const read = (chunk: Buffer) => {
        this.printed += chunk.toString();
        const port = /http:\/\/[^\s/]*:(\d+)/.exec(this.printed)?.[1];
        if (port) {
          clearTimeout(timer);
          resolve(Number(port));
        }
      };
      child.stdout.on("data", read);
      child.stderr.on("data", read);
      child.on("error", reject);
      child.on("exit", (code) => reject(new Error(`the server ended with ${code}:\n${this.printed}`)));
    });
    await until("the server answers", async () => {
      const health = await fetch(`${this.address}/health`).catch(() => null);
      return health?.ok === true;
    });
  }

  /** As a power cut would. */
  async kill(): Promise<void> {
    const child = this.#child;
    if (!child || child.exitCode !== null || child.signalCode !== null) return;
    const ended = new Promise((resolve) => child.once("exit", resolve));
    child.kill("SIGKILL");
    await ended;
  }

  /** It answers nothing until it is resumed; what is sent to it waits. */
  pause(): void {
    this.#child?.kill("SIGSTOP");
  }

  resume(): void {
    this.#child?.kill("SIGCONT");
  }

  async stop(): Promise<void> {
    await this.kill();
    rmSync(this.folder, { recursive: true, force: true });
  }
}

/** Asks again and again until the answer is yes, for so many milliseconds at most. */
export async function until(what: string, check: () => Promise<boolean> | boolean, limit = GUARD): Promise<void> {
  const end = Date.now() + limit;
  while (!(await inTime(what, check(), limit, end - Date.now()))) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** The answer, if it comes within so many milliseconds, of which some are `left`: a page that hangs never gives one. */
export async function inTime<Answer>(
  what: string,
  answer: Promise<Answer> | Answer,
  limit = GUARD,
  left = limit,
): Promise<Answer> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(`${what}: not within ${limit / 1000} s`)), Math.max(0, left));
  });
  try {
    return await Promise.race([answer, late]);
  } finally {
    clearTimeout(timer);
  }
}
