import type { Problem, Reason } from "../../wire/generated";
import { say } from "../words/say";
import { principal } from "./principal";

/** A problem of the server's, or one of the page's own, which has its words and needs no reason. */
export type Trouble = Omit<Problem, "reason"> & { readonly reason?: Reason };

/** A request the server refused, or that never reached it. */
export class RequestFailed extends Error {
  readonly problem: Trouble;
  /** The HTTP status; 0 if there was no answer. */
  readonly status: number;

  constructor(status: number, problem: Trouble) {
    super(problem.message);
    this.name = "RequestFailed";
    this.status = status;
    this.problem = problem;
  }
}

/** What a request asks besides. */
export interface Conditions {
  /** It is refused where what it changes has another revision by now (`LB2`). */
  readonly revision?: number;
  /** It is done once, however often it comes with this key (`IK1`). */
  readonly key?: string;
}

/** Asks the server with JSON, and gives the JSON of its answer; `undefined` where it has no body. */
export async function ask<Answer>(
  method: string,
  path: string,
  body?: object,
  conditions: Conditions = {},
): Promise<Answer> {
  const sent = body && { type: "application/json", body: JSON.stringify(body), ...conditions };
  const response = await askFor(method, path, sent);
  return (await response.json().catch(() => undefined)) as Answer;
}

/** Asks the server; what it refuses, and silence, are thrown as `RequestFailed`. */
export async function askFor(
  method: string,
  path: string,
  sent?: Conditions & { readonly type: string; readonly body: BodyInit },
  how: Pick<RequestInit, "signal" | "keepalive"> = {},
): Promise<Response> {
  let response: Response;
  try {
    const headers = {
      ...principal(),
      ...(sent ? { "content-type": sent.type } : {}),
      ...(sent?.revision === undefined ? {} : { "if-match": `"${sent.revision}"` }),
      ...(sent?.key === undefined ? {} : { "idempotency-key": `"${sent.key}"` }),
    };
    response = await fetch(path, {
      method,
      headers,
      ...(sent ? { body: sent.body } : {}),
      ...how,
    });
  } catch (error) {
    if (how.signal?.aborted) {
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

/** What the reason of a close says (`HS6`): a reason, a colon and a sentence, or who did it (`AC17`). */
export function turnedAway(text: string): RequestFailed {
  const [, reason, message = text] = /^([a-z-]+): ([\s\S]*)$/.exec(text) ?? [];
  return new RequestFailed(0, {
    code: "refused",
    message,
    cause: message,
    ...(reason && { reason: reason as Reason }),
  });
}

/** What no answer at all says. */
export function silence(): RequestFailed {
  return new RequestFailed(0, { code: "unavailable", message: say("problems.silent") });
}

/** What the answer has besides `status`, `type` and `title` is the problem; its sentence is called `detail` (`ER1`). */
function asProblem(json: unknown): Trouble | null {
  const message = typeof json === "object" && json !== null && "detail" in json ? json.detail : null;
  return typeof message === "string" ? { ...(json as Trouble), message } : null;
}

function unexplained(status: number): Trouble {
  return { code: "unavailable", message: say("problems.unexplained", { status }) };
}
