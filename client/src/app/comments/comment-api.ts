import { COMMENT_MINUTES, type NewComment, type NewThread, type Thread } from "../../wire/generated";
import { newClientKey } from "../connection/client-record";
import { ask, askFor } from "../requests/request";

/** So long its words can be changed, in milliseconds (`CT5`). */
export const CHANGED_WITHIN = COMMENT_MINUTES * 60_000;

/** Threads in one answer. */
const PAGE = 200;

/** All that is said of a tree, newest thread first. */
export async function listThreads(tree: string): Promise<readonly Thread[]> {
  const all: Thread[] = [];
  for (;;) {
    const last = all.at(-1)?.thread;
    const before = last === undefined ? "" : `&before=${last}`;
    const page = await ask<Thread[]>("GET", `${pathOf(tree)}?limit=${PAGE}${before}`);
    all.push(...page);
    if (page.length < PAGE) {
      return all;
    }
  }
}

export function findThread(tree: string, thread: number): Promise<Thread> {
  return ask<Thread>("GET", `${pathOf(tree)}/${thread}`);
}

export function beginThread(tree: string, thread: NewThread): Promise<Thread> {
  return ask<Thread>("POST", pathOf(tree), thread, { key: newClientKey() });
}

export function answerIn(tree: string, thread: number, comment: NewComment): Promise<Thread> {
  return ask<Thread>("POST", `${pathOf(tree)}/${thread}/comments`, comment, { key: newClientKey() });
}

export function resolveThread(tree: string, thread: number, resolved: boolean): Promise<Thread> {
  return ask<Thread>("PATCH", `${pathOf(tree)}/${thread}`, { resolved });
}

export function editComment(tree: string, thread: number, comment: number, text: string): Promise<Thread> {
  return ask<Thread>("PATCH", `${pathOf(tree)}/${thread}/comments/${comment}`, { text });
}

/** Also from a page that is closed meanwhile. */
export async function deleteComment(tree: string, thread: number, comment: number): Promise<void> {
  await askFor("DELETE", `${pathOf(tree)}/${thread}/comments/${comment}`, undefined, { keepalive: true });
}

export async function seeThread(tree: string, thread: number, comment: number): Promise<void> {
  await ask<undefined>("PUT", `${pathOf(tree)}/${thread}/seen`, { comment });
}

export function pictureAddress(tree: string, thread: number, comment: number): string {
  return `${pathOf(tree)}/${thread}/comments/${comment}/picture`;
}

/** The page of all that is said, to read and print (`CT6`). */
export function reviewAddress(tree: string, language: string): string {
  return `/api/v1/trees/${encodeURIComponent(tree)}/review.html?language=${language}`;
}

function pathOf(tree: string): string {
  return `/api/v1/trees/${encodeURIComponent(tree)}/threads`;
}
