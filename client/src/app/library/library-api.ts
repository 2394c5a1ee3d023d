import type { NewSession, Problem, RenameTree, SavedTree, SaveTree, SessionCreated } from "../../wire/generated";
import { say } from "../words/say";

/** A request the server refused, or that never reached it. */
export class RequestFailed extends Error {
  readonly problem: Problem;
  /** The HTTP status; 0 if there was no answer. */
  readonly status: number;

  constructor(status: number, problem: Problem) {
    super(problem.message);
    this.name = "RequestFailed";
    this.status = status;
    this.problem = problem;
  }
}

/** Starts a session, empty or from a saved tree. */
export async function createSession(request: NewSession = {}): Promise<string> {
  const created = await ask<SessionCreated>("POST", "/api/sessions", request);
  return created.session;
}

/** Whether a session exists. */
export async function sessionExists(session: string): Promise<boolean> {
  try {
    await ask<SessionCreated>("GET", `/api/sessions/${encodeURIComponent(session)}`);
    return true;
  } catch (error) {
    if (error instanceof RequestFailed && error.status === 404) {
      return false;
    }
    throw error;
  }
}

/** So many saved trees, newest first; behind the one named, if one is. */
export function listTrees(limit: number, behind?: string): Promise<SavedTree[]> {
  const page = new URLSearchParams({ limit: String(limit), ...(behind === undefined ? {} : { behind }) });
  return ask<SavedTree[]>("GET", `/api/trees?${page}`);
}

/** Saves a session's plants in the library. */
export function saveTree(request: SaveTree): Promise<SavedTree> {
  return ask<SavedTree>("POST", "/api/trees", request);
}

export function renameTree(id: string, name: string): Promise<SavedTree> {
  const request: RenameTree = { name };
  return ask<SavedTree>("PATCH", `/api/trees/${encodeURIComponent(id)}`, request);
}

export async function deleteTree(id: string): Promise<void> {
  await ask<undefined>("DELETE", `/api/trees/${encodeURIComponent(id)}`);
}

/** Where a session's plants can be downloaded as glTF. */
export function gltfAddress(session: string): string {
  return `/api/sessions/${encodeURIComponent(session)}/tree.glb`;
}

/** Where a session's socket is. */
export function socketAddress(session: string, page: { protocol: string; host: string }): string {
  const scheme = page.protocol === "https:" ? "wss" : "ws";
  return `${scheme}://${page.host}/api/sessions/${encodeURIComponent(session)}/socket`;
}

async function ask<Answer>(method: string, path: string, body?: object): Promise<Answer> {
  const sent = body && { type: "application/json", body: JSON.stringify(body) };
  const response = await askFor(method, path, sent);
  return (await response.json().catch(() => undefined)) as Answer;
}

/** Asks the server; what it refuses, and silence, are thrown as `RequestFailed`. */
export async function askFor(
  method: string,
  path: string,
  sent?: { readonly type: string; readonly body: BodyInit },
  signal?: AbortSignal,
): Promise<Response> {
  let response: Response;
  try {
    const body = sent && { headers: { "content-type": sent.type }, body: sent.body };
    response = await fetch(path, { method, ...body, ...(signal ? { signal } : {}) });
  } catch (error) {
    if (signal?.aborted) {
      throw error;
    }
    throw silence();
  }
  if (!response.ok) {
    throw refusal(response.status, await response.json().catch(() => undefined));
  }
  return response;
}

/** What an answer that is no success says. */
export function refusal(status: number, json: unknown): RequestFailed {
  return new RequestFailed(status, asProblem(json) ?? unexplained(status));
}

/** What no answer at all says. */
export function silence(): RequestFailed {
  return new RequestFailed(0, { code: "unavailable", message: say("problems.silent") });
}

function asProblem(json: unknown): Problem | null {
  const message = typeof json === "object" && json !== null && "message" in json ? json.message : null;
  return typeof message === "string" ? (json as Problem) : null;
}

function unexplained(status: number): Problem {
  return { code: "unavailable", message: say("problems.unexplained", { status }) };
}
